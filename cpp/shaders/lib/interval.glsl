// A caster with extent along the light: its optical depth grows evenly from where the light enters
// it to where it leaves. C++: map/interval.hpp.

// The part of it in front of a depth. A point, whose begin is its end, is in front of what lies
// strictly behind it.
float part_in_front(float begin, float end, float depth) {
    if (end > begin) return clamp((depth - begin) / (end - begin), 0.0, 1.0);
    return depth > begin ? 1.0 : 0.0;
}
