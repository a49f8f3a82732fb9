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

// One segment in light space, with x its major axis: the one along which it covers more texels.
struct MajorSegment {
    vec2 root, along;      // its start, and from there to its tip
    vec2 depth;            // of root and tip
    bool steep;            // x and y are exchanged
    float slope, stretch;  // along.y / along.x, and the length over one texel of x
};

MajorSegment major_segment(vec3 root, vec3 tip) {
    vec2 a = root.xy, d = tip.xy - root.xy;
    bool steep = abs(d.y) > abs(d.x);
    if (steep) a = a.yx, d = d.yx;
    precise float slope = d.y / d.x;
    precise float stretch = sqrt(1.0 + slope * slope);
    return MajorSegment(a, d, vec2(root.z, tip.z), steep, slope, stretch);
}

vec2 on_axes(MajorSegment s, vec2 texel) { return s.steep ? texel.yx : texel; }

// Where its line passes x.
float line_at(MajorSegment s, float x) {
    precise float y = s.root.y + s.slope * (x - s.root.x);
    return y;
}

// A ribbon in one column of its major axis, whose middle is at `column`. All is evaluated on the
// segment's line at that middle, so that cutting a segment in two changes nothing.
struct RibbonColumn {
    float along;  // f; nothing is covered where it is not above 0
    float place, half_width, y, depth;
};

// The widths of root and tip.
RibbonColumn ribbon_column(MajorSegment s, vec2 width_texels, float column) {
    vec2 ends = vec2(s.root.x, s.root.x + s.along.x);
    precise float f = min(max(ends.x, ends.y), column + 0.5) - max(min(ends.x, ends.y), column - 0.5);
    precise float place = clamp((column - s.root.x) / s.along.x, 0.0, 1.0);
    precise float width = mix(width_texels.x, width_texels.y, place);
    precise float half_width = 0.5 * width * s.stretch;
    precise float depth = mix(s.depth.x, s.depth.y, place);
    return RibbonColumn(f, place, half_width, line_at(s, column), depth);
}

// The texel whose middle is at `row`.
bool row_coverage(RibbonColumn ribbon, float row, out Coverage coverage) {
    coverage = Coverage(0.0, 0.0, 0.0, 0.0);
    precise float top = min(ribbon.y + ribbon.half_width, row + 0.5);
    precise float c = clamp(top - max(ribbon.y - ribbon.half_width, row - 0.5), 0.0, 1.0);
    if (!(ribbon.along > 0.0 && c > 0.0)) return false;
    coverage = Coverage(min(ribbon.along, 1.0), c, ribbon.place, ribbon.depth);
    return true;
}

// By the middle of the texel.
bool ribbon_coverage(MajorSegment s, vec2 width_texels, vec2 texel, out Coverage coverage) {
    texel = on_axes(s, texel);
    return row_coverage(ribbon_column(s, width_texels, texel.x), texel.y, coverage);
}

// The papers' deposit: a line one texel wide, whatever the strand's width, with one fragment in
// each column whose middle the segment passes.
bool line_coverage(MajorSegment s, vec2 texel, out Coverage coverage) {
    coverage = Coverage(0.0, 0.0, 0.0, 0.0);
    texel = on_axes(s, texel);
    vec2 ends = vec2(s.root.x, s.root.x + s.along.x);
    bool passes = min(ends.x, ends.y) <= texel.x && texel.x < max(ends.x, ends.y);
    if (!passes) return false;
    precise float place = (texel.x - s.root.x) / s.along.x;
    precise float y = s.root.y + place * s.along.y;
    if (floor(y) != floor(texel.y)) return false;
    precise float depth = mix(s.depth.x, s.depth.y, place);
    coverage = Coverage(1.0, 1.0, place, depth);
    return true;
}
