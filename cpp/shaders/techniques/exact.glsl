// Exact: all fragments of each texel, sorted by depth, with the running sum of their optical depth.
#include "lib/fragment_list.glsl"

#ifdef PASS_count
#include "lib/deposit.glsl"
layout(r32ui) uniform uimage2D i_count;

void main() {
    deposit_or_discard();
    imageAtomicAdd(i_count, ivec2(gl_FragCoord.xy), 1u);
}
#endif

#ifdef PASS_store
#include "lib/deposit.glsl"
uniform usampler2D t_first, t_count;
layout(r32ui) uniform uimage2D i_stored;
layout(rgba32f) writeonly uniform image2D i_unsorted;

void main() {
    Deposit deposit = deposit_or_discard();
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uint index = imageAtomicAdd(i_stored, texel, 1u);
    // The same fragments arrive as were counted; a driver that disagrees must not write into the
    // next texel's list.
    if (index >= texelFetch(t_count, texel, 0).x) return;
    uint first = texelFetch(t_first, texel, 0).x;
    vec4 entry = vec4(deposit.depth, deposit.optical_depth, texel);
    imageStore(i_unsorted, list_place(first + index), entry);
}
#endif

#ifdef PASS_sort
#include "lib/invocation.glsl"
uniform usampler2D t_first, t_count;
uniform sampler2D t_unsorted;
layout(rgba32f) uniform image2D i_list, i_scratch;
layout(r32f) uniform image2D i_sum;
uniform int u_step;    // step_*
uniform int u_source;  // from_*
uniform bool u_into_list;
uniform int u_run;
uniform int u_fragments;
uniform int u_chunk_begin, u_chunk_end;

const int step_merge = 0, step_sum = 1;
const int from_unsorted = 0, from_list = 1, from_scratch = 2;

vec4 entry(uint index) {
    ivec2 place = list_place(index);
    if (u_source == from_unsorted) return texelFetch(t_unsorted, place, 0);
    return u_source == from_list ? imageLoad(i_list, place) : imageLoad(i_scratch, place);
}

bool before(vec2 a, vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

// One step of a merge sort: runs of u_run entries, sorted, become runs of twice that. Each entry
// finds its own place by binary search in the run beside its own, so no invocation loops for long
// whatever a texel holds. Equal depths are ordered by optical depth: the result does not depend on
// the order in which fragments arrived.
void merge(uint index) {
    vec4 mine = entry(index);
    ivec2 texel = ivec2(mine.zw);
    uint first = texelFetch(t_first, texel, 0).x, count = texelFetch(t_count, texel, 0).x;
    uint local = index - first, run = local / uint(u_run), other = run ^ 1u;
    uint low = min(other * uint(u_run), count), high = min((other + 1u) * uint(u_run), count);
    uint other_begin = low;
    while (low < high) {
        uint middle = (low + high) / 2u;
        vec2 theirs = entry(first + middle).xy;
        bool passes = other < run ? !before(mine.xy, theirs) : before(theirs, mine.xy);
        if (passes) low = middle + 1u;
        else high = middle;
    }
    uint place = first + min(run, other) * uint(u_run) + (local - run * uint(u_run)) + (low - other_begin);
    if (u_into_list) imageStore(i_list, list_place(place), mine);
    else imageStore(i_scratch, list_place(place), mine);
}

// The running sum of one texel's sorted list, with Kahan's compensation, in chunks: some drivers
// end all loops of an invocation after 65,535 turns.
void accumulate(uint index) {
    ivec2 size = textureSize(t_count, 0), texel = ivec2(int(index) % size.x, int(index) / size.x);
    uint first = texelFetch(t_first, texel, 0).x;
    uint end = min(texelFetch(t_count, texel, 0).x, uint(u_chunk_end));
    float sum = u_chunk_begin > 0 ? imageLoad(i_sum, texel).x : 0.0;
    precise float lost = 0.0;
    for (uint i = uint(u_chunk_begin); i < end; ++i) {
        vec4 mine = imageLoad(i_list, list_place(first + i));
        precise float added = mine.y - lost;
        precise float next = sum + added;
        lost = (next - sum) - added;
        sum = next;
        imageStore(i_list, list_place(first + i), vec4(mine.x, sum, mine.zw));
    }
    imageStore(i_sum, texel, vec4(sum));
}

void main() {
    uint index = invocation_index();
    ivec2 map_size = textureSize(t_count, 0);
    if (u_step == step_merge && index < uint(u_fragments)) merge(index);
    if (u_step == step_sum && index < uint(map_size.x * map_size.y)) accumulate(index);
}
#endif

#if !defined(PASS_count) && !defined(PASS_store) && !defined(PASS_sort)
#include "lib/receiver.glsl"

uniform usampler2D t_first, t_count;
uniform sampler2D t_list;

float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    uint first = texelFetch(t_first, texel, 0).x;
    uint low = 0u, high = texelFetch(t_count, texel, 0).x;
    while (low < high) {  // the number of fragments strictly in front
        uint middle = (low + high) / 2u;
        if (texelFetch(t_list, list_place(first + middle), 0).x < depth) low = middle + 1u;
        else high = middle;
    }
    return low == 0u ? 0.0 : texelFetch(t_list, list_place(first + low - 1u), 0).y;
}

#include "lib/lookup.glsl"
#endif
