// One plane of a sweep over opacity layers: four of them lie in the channels of a texture, and plane k
// follows plane k - 4, in whose place it comes when what lies in between is added.
#include "lib/deposit.glsl"
#include "lib/layer_map.glsl"
#include "lib/planes.glsl"

uniform int u_plane;

layout(location = 0) out vec4 o_slices;

void main() {
    Deposit deposit = deposit_or_discard();
    float first = between(0.0, 1.0, deposit.depth), last = between(0.0, 1.0, deposit.depth_end);
    vec2 part = vec2(counted_at(0, u_plane, first, last), 0.0);
    if (u_plane > 4) part.y = counted_at(0, u_plane - 4, first, last);
    vec2 sums = stored(deposit.optical_depth * part.xyxy).xy;
    if (!(sums.x > sums.y)) discard;
    o_slices = (sums.x - sums.y) * vec4(equal(ivec4(0, 1, 2, 3), ivec4((u_plane - 1) % 4)));
}
