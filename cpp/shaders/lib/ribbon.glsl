// The part of a texel that a strand's ribbon covers, by the deposit rule (docs/accuracy.md). The
// deposit and the correction of a receiver's own deposit share it. C++: map/ribbon.hpp.

// Where a receiver's strand goes on, it does so for as far as any filter reaches.
const float endless_texels = 64.0;

struct Coverage {
    float along;   // f: the part of the column that the segment spans
    float across;  // c: the part of the texel that the ribbon covers across the strand
    float place;   // where on the segment: 0 at its root, 1 at its tip
    float depth;
};

// Root and tip in light space, the width in texels at both, the middle of the texel. c is evaluated
// on the segment's line at the column's centre, so that cutting a segment in two changes nothing.
bool ribbon_coverage(vec3 root, vec3 tip, vec2 width_texels, vec2 texel, out Coverage coverage) {
    coverage = Coverage(0.0, 0.0, 0.0, 0.0);
    vec2 a = root.xy, d = tip.xy - root.xy;
    if (abs(d.y) > abs(d.x)) a = a.yx, d = d.yx, texel = texel.yx;
    precise float f = min(max(a.x, a.x + d.x), texel.x + 0.5) - max(min(a.x, a.x + d.x), texel.x - 0.5);
    if (!(f > 0.0)) return false;
    precise float slope = d.y / d.x;
    precise float place = clamp((texel.x - a.x) / d.x, 0.0, 1.0);
    precise float width = mix(width_texels.x, width_texels.y, place);
    precise float half_width = 0.5 * width * sqrt(1.0 + slope * slope);
    precise float y = a.y + slope * (texel.x - a.x);
    precise float top = min(y + half_width, texel.y + 0.5);
    precise float c = clamp(top - max(y - half_width, texel.y - 0.5), 0.0, 1.0);
    if (!(c > 0.0)) return false;
    precise float depth = mix(root.z, tip.z, place);
    coverage = Coverage(min(f, 1.0), c, place, depth);
    return true;
}

// The papers' deposit: a line one texel wide, whatever the strand's width, with one fragment in
// each column whose middle the segment passes.
bool line_coverage(vec3 root, vec3 tip, vec2 texel, out Coverage coverage) {
    coverage = Coverage(0.0, 0.0, 0.0, 0.0);
    vec2 a = root.xy, d = tip.xy - root.xy;
    if (abs(d.y) > abs(d.x)) a = a.yx, d = d.yx, texel = texel.yx;
    bool passes = min(a.x, a.x + d.x) <= texel.x && texel.x < max(a.x, a.x + d.x);
    if (!passes) return false;
    precise float place = (texel.x - a.x) / d.x;
    precise float y = a.y + place * d.y;
    if (floor(y) != floor(texel.y)) return false;
    precise float depth = mix(root.z, tip.z, place);
    coverage = Coverage(1.0, 1.0, place, depth);
    return true;
}
