// The passes that list all fragments of each texel, sorted by depth, with the running sum of their
// optical depth; C++: techniques/fragment_lists.hpp.
#include "lib/fragment_list.glsl"

#ifdef PASS_count
#include "lib/deposit.glsl"
layout(r32ui) uniform uimage2D i_count;

void main() {
    deposit_or_discard();
    imageAtomicAdd(i_count, ivec2(gl_FragCoord.xy), uint(deposit_ends));
}
#endif

#ifdef PASS_store
#include "lib/deposit.glsl"
uniform usampler2D t_first, t_count;
layout(r32ui) uniform uimage2D i_stored;
layout(rgba32ui) writeonly uniform uimage2D i_unsorted;

// A shorter one is a point: its density would drown that of others in rounding.
const float least_interval = 1.0 / 1048576.0;

void main() {
    Deposit deposit = deposit_or_discard();
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uint index = imageAtomicAdd(i_stored, texel, uint(deposit_ends));
    // The same fragments arrive as were counted; a driver that disagrees must not write into the
    // next texel's list.
    if (index + uint(deposit_ends) > texelFetch(t_count, texel, 0).x) return;
    index += texelFetch(t_first, texel, 0).x;
    uint place = uint(texel.y * textureSize(t_count, 0).x + texel.x);
    precise float length = deposit.depth_end - deposit.depth;
    bool is_point = !(length >= least_interval);
    float density = is_point ? 0.0 : deposit.optical_depth / length;
    Entry begin = Entry(deposit.depth, is_point ? deposit.optical_depth : 0.0, density, place);
    imageStore(i_unsorted, list_place(index), bits_of(begin));
    Entry end = Entry(is_point ? deposit.depth : deposit.depth_end, 0.0, -density, place);
    if (deposit_ends > 1) imageStore(i_unsorted, list_place(index + 1u), bits_of(end));
}
#endif

#ifdef PASS_sort
#include "lib/invocation.glsl"
uniform usampler2D t_first, t_count;
uniform usampler2D t_unsorted;
layout(rgba32ui) uniform uimage2D i_list, i_scratch;
layout(rgba32f) uniform image2D i_sums;
uniform int u_step;    // step_*
uniform int u_source;  // from_*
uniform bool u_into_list;
uniform int u_run;
uniform int u_entries;
uniform int u_chunk_begin, u_chunk_end;

const int step_merge = 0, step_sum = 1;
const int from_unsorted = 0, from_list = 1, from_scratch = 2;

uvec4 bits_at(uint index) {
    ivec2 place = list_place(index);
    if (u_source == from_unsorted) return texelFetch(t_unsorted, place, 0);
    return u_source == from_list ? imageLoad(i_list, place) : imageLoad(i_scratch, place);
}

bool before(Entry a, Entry b) {
    if (a.depth != b.depth) return a.depth < b.depth;
    return a.optical_depth < b.optical_depth || (a.optical_depth == b.optical_depth && a.density < b.density);
}

// One step of a merge sort: runs of u_run entries, sorted, become runs of twice that. Each entry
// finds its own place by binary search in the run beside its own, so no invocation loops for long
// whatever a texel holds. Equal depths are ordered by what they add: the result does not depend on
// the order in which fragments arrived.
void merge(uint index) {
    uvec4 bits = bits_at(index);
    Entry mine = entry_of(bits);
    int width = textureSize(t_count, 0).x;
    ivec2 texel = ivec2(int(mine.texel) % width, int(mine.texel) / width);
    uint first = texelFetch(t_first, texel, 0).x, count = texelFetch(t_count, texel, 0).x;
    uint local = index - first, run = local / uint(u_run), other = run ^ 1u;
    uint low = min(other * uint(u_run), count), high = min((other + 1u) * uint(u_run), count);
    uint other_begin = low;
    while (low < high) {
        uint middle = (low + high) / 2u;
        Entry theirs = entry_of(bits_at(first + middle));
        bool passes = other < run ? !before(mine, theirs) : before(theirs, mine);
        if (passes) low = middle + 1u;
        else high = middle;
    }
    uint place = first + min(run, other) * uint(u_run) + (local - run * uint(u_run)) + (low - other_begin);
    if (u_into_list) imageStore(i_list, list_place(place), bits);
    else imageStore(i_scratch, list_place(place), bits);
}

// Of one texel, up to some entry. Densities are added and taken away again, in any order: what
// rounding loses is kept beside the sum (Neumaier 1974), and nothing is left where no interval is.
struct Sums {
    float optical_depth;
    float density, density_lost;
    float intervals;  // that have begun and not ended
};

float density_of(Sums sums) { return max(sums.density + sums.density_lost, 0.0); }

void add_density(inout Sums sums, float added) {
    sums.intervals += sign(added);
    precise float sum = sums.density + added;
    precise float lost = abs(sums.density) >= abs(added) ? (sums.density - sum) + added : (added - sum) + sums.density;
    sums.density = sum;
    sums.density_lost += lost;
    if (sums.intervals == 0.0) sums.density = sums.density_lost = 0.0;
}

// The running sums of one texel's sorted list, of optical depth with Kahan's compensation, in chunks:
// some drivers end all loops of an invocation after 65,535 turns.
void accumulate(uint index) {
    ivec2 size = textureSize(t_count, 0), texel = ivec2(int(index) % size.x, int(index) / size.x);
    uint first = texelFetch(t_first, texel, 0).x;
    uint end = min(texelFetch(t_count, texel, 0).x, uint(u_chunk_end));
    Sums sums = Sums(0.0, 0.0, 0.0, 0.0);
    float depth = 0.0;
    if (u_chunk_begin > 0 && uint(u_chunk_begin) < end) {
        vec4 kept = imageLoad(i_sums, texel);
        sums = Sums(kept.x, kept.y, kept.z, kept.w);
        depth = entry_of(imageLoad(i_list, list_place(first + uint(u_chunk_begin) - 1u))).depth;
    }
    precise float lost = 0.0;
    for (uint i = uint(u_chunk_begin); i < end; ++i) {
        Entry mine = entry_of(imageLoad(i_list, list_place(first + i)));
        precise float here = mine.optical_depth + density_of(sums) * (mine.depth - depth);
        precise float added = here - lost;
        precise float next = sums.optical_depth + added;
        lost = (next - sums.optical_depth) - added;
        sums.optical_depth = next;
        depth = mine.depth;
        if (mine.density != 0.0) add_density(sums, mine.density);
        Entry summed = Entry(depth, sums.optical_depth, density_of(sums), mine.texel);
        imageStore(i_list, list_place(first + i), bits_of(summed));
    }
    imageStore(i_sums, texel, vec4(sums.optical_depth, sums.density, sums.density_lost, sums.intervals));
}

void main() {
    uint index = invocation_index();
    ivec2 map_size = textureSize(t_count, 0);
    if (u_step == step_merge && index < uint(u_entries)) merge(index);
    if (u_step == step_sum && index < uint(map_size.x * map_size.y)) accumulate(index);
}
#endif
