#include "map/volume_slabs.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace opacity {
namespace {

struct Span {
    Voxel begin, end;  // empty where begin is not below end
    void extend(const Voxel& first, const Voxel& last) {
        for (std::size_t i = 0; i < 3; ++i) {
            begin[i] = std::min(begin[i], first[i]);
            end[i] = std::max(end[i], last[i] + 1);
        }
    }
};

class Slabs {
   public:
    explicit Slabs(const Voxel& size) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            thickness_[axis] = (size[axis] + most_slabs - 1) / most_slabs;
            const int count = (size[axis] + thickness_[axis] - 1) / thickness_[axis];
            spans_[axis].assign(std::size_t(count), {size, {0, 0, 0}});
        }
    }
    // The voxels of one row that are not empty, from first to last.
    void add(const Voxel& first, const Voxel& last) {
        for (std::size_t axis : {1, 2})
            spans_[axis][std::size_t(first[axis] / thickness_[axis])].extend(first, last);
    }
    void add_across_x(const Voxel& voxel) {
        spans_[0][std::size_t(voxel[0] / thickness_[0])].extend(voxel, voxel);
    }
    std::vector<Slab> filled() const {
        std::vector<Slab> slabs;
        for (int axis = 0; axis < 3; ++axis)
            for (const Span& span : spans_[std::size_t(axis)])
                if (span.begin[0] < span.end[0]) slabs.push_back({axis, span.begin, span.end});
        return slabs;
    }

   private:
    Voxel thickness_{};
    std::array<std::vector<Span>, 3> spans_;
};

}  // namespace

std::vector<Slab> slabs_of(const Volume& volume) {
    const auto& [nz, ny, nx] = volume.size_zyx();
    Slabs slabs{{nx, ny, nz}};
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y) {
            const std::size_t row_begin = (std::size_t(z) * ny + y) * nx;
            const std::span<const float> row{&volume.extinction()[row_begin], std::size_t(nx)};
            int first = nx, last = -1;
            for (int x = 0; x < nx; ++x) {
                if (!(row[std::size_t(x)] > 0.f)) continue;
                first = std::min(first, x), last = x;
                slabs.add_across_x({x, y, z});
            }
            if (last >= 0) slabs.add({first, y, z}, {last, y, z});
        }
    return slabs.filled();
}

}  // namespace opacity
