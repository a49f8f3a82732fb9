// Layer planes that each tile of TILE_PX x TILE_PX texels has for itself, on [0, 1]: plane 0 is 0, the
// last one is 1, and those between are four to an image. C++: TilePlanes in techniques/drawn_layers.hpp.
uniform sampler2DArray t_tile_planes;

int tile_of(ivec2 texel) {
    ivec2 tile = texel / TILE_PX;
    return tile.y * textureSize(t_tile_planes, 0).x + tile.x;
}

float tile_plane(int tile, int k, int last) {
    if (k <= 0 || k >= last) return k <= 0 ? 0.0 : 1.0;
    int across = textureSize(t_tile_planes, 0).x;
    return texelFetch(t_tile_planes, ivec3(tile % across, tile / across, (k - 1) / 4), 0)[(k - 1) % 4];
}
