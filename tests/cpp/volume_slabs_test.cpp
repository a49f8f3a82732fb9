// The slabs of a volume hold every voxel that is not empty once across each axis, and little else.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "map/volume_slabs.hpp"

using namespace opacity;

namespace {

// Of each axis the voxels that its slabs hold, and how often.
std::map<std::pair<int, Voxel>, int> held(const std::vector<Slab>& slabs) {
    std::map<std::pair<int, Voxel>, int> counts;
    for (const Slab& slab : slabs)
        for (int z = slab.begin[2]; z < slab.end[2]; ++z)
            for (int y = slab.begin[1]; y < slab.end[1]; ++y)
                for (int x = slab.begin[0]; x < slab.end[0]; ++x)
                    ++counts[{slab.axis, Voxel{x, y, z}}];
    return counts;
}

}  // namespace

TEST_CASE("slabs hold each voxel that is not empty once across each axis") {
    const int nx = 5, ny = 150, nz = 4;
    std::vector<float> extinction(std::size_t(nx) * ny * nz, 0.f);
    std::vector<Voxel> filled{{0, 0, 0}, {4, 149, 3}, {2, 77, 1}, {2, 78, 1}, {3, 10, 2}};
    for (const auto& [x, y, z] : filled) extinction[std::size_t((z * ny + y) * nx + x)] = 1.f;
    const Volume volume{{nz, ny, nx}, extinction};
    const std::vector<Slab> slabs = slabs_of(volume);
    const auto counts = held(slabs);
    for (int axis = 0; axis < 3; ++axis)
        for (const Voxel& voxel : filled) CHECK(counts.at({axis, voxel}) == 1);
    for (int axis = 0; axis < 3; ++axis)
        CHECK(std::ranges::count(slabs, axis, &Slab::axis) <= most_slabs);
    CHECK(std::ranges::is_sorted(slabs, {}, &Slab::axis));
    // Layers with one voxel are no larger than it; 150 layers are merged by three.
    for (const Slab& slab : slabs)
        if (slab.axis == 1) CHECK(slab.end[1] - slab.begin[1] <= 2);
    CHECK(slabs_of(Volume{{1, 1, 1}, {0.f}}).empty());
}
