// A segment becomes the parallelogram that holds every texel which its ribbon touches.
#include "casters/strands.glsl"

void place_caster() {
    if (!place_segment(segment_index())) {
        gl_Position = clipped_away();
        return;
    }
    MajorSegment s = major_segment(v_root, v_tip);
    float half_width = 0.5 * max(v_width_texels.x, v_width_texels.y) * s.stretch;
    float reach = half_width + 0.5 + 1.0 / 64.0;  // more than rasterisers round corners by
    vec2 corner = segment_corner(), columns = columns_of(s);
    float x = mix(columns.x, columns.y, corner.x);
    gl_Position = clip_from_texels(on_axes(s, vec2(x, line_at(s, x) + corner.y * reach)));
}
