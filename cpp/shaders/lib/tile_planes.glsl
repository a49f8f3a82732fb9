// Layer planes that each tile of TILE_PX x TILE_PX texels has for itself, on [0, 1]: plane 0 is 0, the
// last one is 1, and those between are four to an image. C++: TilePlanes in techniques/drawn_layers.hpp.
uniform sampler2DArray t_tile_planes;

// Where an image has no plane any more: behind all casters.
const float no_plane = 2.0;

// A tile's place in the images, as one number: 16 bits across, and 16 down.
int tile_index(ivec2 tile) { return tile.y << 16 | tile.x; }

// Four planes, from 4 image + 1 on.
vec4 four_planes(int tile, int image) {
    return texelFetch(t_tile_planes, ivec3(tile & 0xffff, tile >> 16, image), 0);
}

int tile_of(ivec2 texel) { return tile_index(texel / TILE_PX); }

float tile_plane(int tile, int k, int last) {
    if (k <= 0 || k >= last) return k <= 0 ? 0.0 : 1.0;
    return four_planes(tile, (k - 1) / 4)[(k - 1) % 4];
}

// The layer of x, as layer_of finds it: by halves of the images, since a look takes four planes.
int tile_layer_of(int tile, float x, int last) {
    int low = 0, high = (last + 2) / 4;
    while (low < high) {
        int middle = (low + high) / 2;
        int passed = int(dot(vec4(greaterThanEqual(vec4(x), four_planes(tile, middle))), vec4(1.0)));
        if (passed % 4 != 0) return 4 * middle + passed;
        if (passed == 0) high = middle;
        else low = middle + 1;
    }
    return min(4 * low, last - 1);
}
