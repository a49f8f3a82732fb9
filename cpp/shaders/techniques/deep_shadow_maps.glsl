// Deep shadow maps: see deep_shadow_maps.hpp. The lists are those of fragment_lists.glsl.
#include "lib/fragment_list.glsl"

// A node is two floats, depth and T: this is where the first is.
ivec2 node_place(uint index) { return list_place(2u * index); }

#if defined(PASS_node_count) || defined(PASS_nodes)
#include "lib/invocation.glsl"
uniform usampler2D t_first, t_count, t_list;
uniform float u_error_bound;
uniform int u_nodes;  // the most that a texel keeps; 0: any
uniform int u_part_begin, u_part_end;

uint kept;  // nodes of this texel so far

bool keeps_none() { return kept == 0u; }

#ifdef PASS_node_count
layout(r32ui) uniform uimage2D i_node_count;
#define i_kept i_node_count

void keep(float depth, float transmittance) {
    if (u_nodes == 0 || kept < uint(u_nodes)) ++kept;
}
#else
uniform usampler2D t_node_first;
layout(r32ui) uniform uimage2D i_nodes_kept;
layout(r32f) uniform image2D i_node_list;
#define i_kept i_nodes_kept

uint first_node;

vec2 node(uint i) {
    ivec2 place = node_place(first_node + i);
    return vec2(imageLoad(i_node_list, place).x, imageLoad(i_node_list, place + ivec2(1, 0)).x);
}

void set_node(uint i, vec2 value) {
    ivec2 place = node_place(first_node + i);
    imageStore(i_node_list, place, vec4(value.x));
    imageStore(i_node_list, place + ivec2(1, 0), vec4(value.y));
}

// Of all nodes but the first, the one whose triangle with its neighbours is least (Salvi et al.
// 2010); `last` comes behind them.
uint least_node(vec2 last) {
    uint least = 0u;
    float least_area = 1e30;
    vec2 before = node(0u), here = kept > 1u ? node(1u) : last;
    for (uint i = 1u; i < kept; ++i) {
        vec2 behind = i + 1u < kept ? node(i + 1u) : last;
        vec2 wide = behind - before, narrow = behind - here;
        float area = abs(wide.x * narrow.y - narrow.x * wide.y);
        if (area < least_area) {
            least = i;
            least_area = area;
        }
        before = here;
        here = behind;
    }
    return least;
}

void keep(float depth, float transmittance) {
    vec2 last = vec2(depth, transmittance);
    if (u_nodes == 0 || kept < uint(u_nodes)) {
        set_node(kept++, last);
        return;
    }
    for (uint i = least_node(last); i + 1u < kept; ++i) set_node(i, node(i + 1u));
    set_node(kept - 1u, last);
}
#endif

#include "lib/transmittance_line.glsl"

// Inside an interval T falls as exp: chords follow it within a quarter of the bound, so that lines
// near the chords stay within the whole. Chords lie above the curve.
const float least_chord_error = 1e-4;

float chord_error() { return max(0.25 * u_error_bound, least_chord_error); }

float lowest;  // T where this part of the list ends: no node is darker

void add_depth(float depth, float optical_depth, bool is_on_chord) {
    float transmittance = exp(-optical_depth);
    float above = is_on_chord ? max(u_error_bound - chord_error(), 0.0) : u_error_bound;
    float low = min(max(transmittance - u_error_bound, lowest), transmittance);
    add_vertex(depth, transmittance, low, transmittance + above);
}

// From an entry to the next depth. One call in one loop: a driver that runs all that is inlined, taken
// or not, counts its loops each time.
void add_ramp(Entry entry, float depth) {
    bool is_interval = entry.density > 0.0;
    float end = entry.optical_depth + entry.density * (depth - entry.depth);
    float step = sqrt(8.0 * chord_error()), reached = entry.optical_depth;
    float there = entry.depth;
    for (bool is_last = false;; is_last = !(reached < end)) {
        add_depth(is_last ? depth : there, is_last ? end : reached, is_interval);
        if (is_last) return;
        reached += step * exp(0.5 * reached);
        there = min(entry.depth + (reached - entry.optical_depth) / entry.density, depth);
    }
}

// A part of a list begins and ends exactly where T does: nothing else passes from one to the next.
void compress(uint first, uint begin, uint end) {
    Entry last = entry_of(texelFetch(t_list, list_place(first + max(begin, 1u) - 1u), 0));
    if (begin == 0u) last = Entry(last.depth, 0.0, 0.0, 0u);
    float end_transmittance = exp(-entry_of(texelFetch(t_list, list_place(first + end - 1u), 0)).optical_depth);
    lowest = end_transmittance;
    start_line(last.depth, exp(-last.optical_depth));
    for (uint i = begin; i < end; ++i) {
        Entry here = entry_of(texelFetch(t_list, list_place(first + i), 0));
        if (here.depth > last.depth) add_ramp(last, here.depth);
        last = here;
    }
    add_vertex(last.depth, end_transmittance, end_transmittance, end_transmittance);
    end_line();
}

void main() {
    uint index = invocation_index();
    ivec2 size = textureSize(t_count, 0), texel = ivec2(int(index) % size.x, int(index) / size.x);
    if (texel.y >= size.y) return;
    uint end = min(texelFetch(t_count, texel, 0).x, uint(u_part_end));
    if (uint(u_part_begin) >= end) return;
    kept = imageLoad(i_kept, texel).x;
#ifdef PASS_nodes
    first_node = texelFetch(t_node_first, texel, 0).x;
#endif
    compress(texelFetch(t_first, texel, 0).x, uint(u_part_begin), end);
    imageStore(i_kept, texel, uvec4(kept));
}
#else

#include "lib/interval.glsl"
#include "lib/receiver.glsl"

uniform usampler2D t_node_first, t_node_count;
uniform sampler2D t_node_list;

float node_depth(uint index) { return texelFetch(t_node_list, node_place(index), 0).x; }
float node_transmittance(uint index) { return texelFetch(t_node_list, node_place(index) + ivec2(1, 0), 0).x; }

float texel_transmittance(ivec2 texel, float depth) {
    uint first = texelFetch(t_node_first, texel, 0).x, count = texelFetch(t_node_count, texel, 0).x;
    uint low = 0u, high = count;
    while (low < high) {  // the number of nodes strictly in front
        uint middle = (low + high) / 2u;
        if (node_depth(first + middle) < depth) low = middle + 1u;
        else high = middle;
    }
    if (low == 0u) return 1.0;
    uint before = first + low - 1u, behind = before + 1u;
    if (low == count) return node_transmittance(before);
    float part = (depth - node_depth(before)) / (node_depth(behind) - node_depth(before));
    return mix(node_transmittance(before), node_transmittance(behind), part);
}

const float least_transmittance = 1e-37;  // what float32 still has a logarithm of

float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    float in_front = -log(max(texel_transmittance(texel, depth), least_transmittance));
    return in_front - own.optical_depth * part_in_front(own.depth, own.depth_end, depth);
}

#include "lib/lookup.glsl"
#endif
