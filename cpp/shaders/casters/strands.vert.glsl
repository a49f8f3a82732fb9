// A segment becomes the parallelogram that holds every texel which its ribbon touches.
#include "casters/strands.glsl"

void place_caster() {
    if (!place_segment(segment_index())) {
        gl_Position = clipped_away();
        return;
    }
    Band band = placed_band();
    float reach = band.half_width + 0.5 + 1.0 / 64.0;  // more than rasterisers round corners by
    vec2 corner = segment_corner();
    float x = mix(band.columns.x, band.columns.y, corner.x);
    vec2 p = vec2(x, line_at(band, x) + corner.y * reach);
    gl_Position = clip_from_texels(band.steep ? p.yx : p);
}
