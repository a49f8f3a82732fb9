#include "opacity/scene/strands.hpp"

#include <algorithm>
#include <functional>
#include <mutex>
#include <numeric>
#include <string>

#include "opacity/core/error.hpp"
#include "scene/check.hpp"
#include "scene/strand_ranks.hpp"

namespace opacity {
namespace {

void check_offsets(const std::vector<std::int64_t>& offsets, std::size_t points) {
    const std::string fix = "pass offsets that start at 0, never fall, and end at " +
                            std::to_string(points) + ", the number of points";
    if (offsets.empty()) throw ParameterError("offsets is empty", fix);
    if (offsets.front() != 0)
        throw ParameterError("offsets[0] = " + std::to_string(offsets.front()) + " is not 0", fix);
    const auto fall = std::adjacent_find(offsets.begin(), offsets.end(), std::greater<>{});
    if (fall != offsets.end())
        throw ParameterError("offsets[" + std::to_string(fall - offsets.begin() + 1) +
                                 "] = " + std::to_string(fall[1]) +
                                 " is less than the one before it, " + std::to_string(fall[0]),
                             fix);
    if (static_cast<std::uint64_t>(offsets.back()) != points)
        throw ParameterError("offsets ends at " + std::to_string(offsets.back()) + " for " +
                                 std::to_string(points) + " points",
                             fix);
}

std::vector<std::uint32_t> segments_of(const std::vector<std::int64_t>& offsets) {
    std::vector<std::uint32_t> segments;
    segments.reserve(static_cast<std::size_t>(offsets.back()));
    for (std::size_t strand = 0; strand + 1 < offsets.size(); ++strand)
        for (std::int64_t i = offsets[strand]; i + 1 < offsets[strand + 1]; ++i)
            segments.push_back(static_cast<std::uint32_t>(i));
    return segments;
}

}  // namespace

struct Strands::RankSlot {
    std::once_flag found;
    StrandRanks ranks;
};

Strands::Strands(Positions points, std::vector<std::int64_t> offsets, std::vector<float> width,
                 std::vector<float> opacity, std::vector<float3> color)
    : Shape{std::move(points), std::move(opacity), std::move(color)},
      ranks_{std::make_shared<RankSlot>()} {
    check_offsets(offsets, points_.size());
    segments_ = segments_of(offsets);
    offsets_ = std::move(offsets);
    assign_width(std::move(width));
}

void Strands::assign_width(std::vector<float> width) {
    check_attribute_size("width", width.size());
    check_values("width", width, not_negative);
    const double sum = std::accumulate(width.begin(), width.end(), 0.0);
    max_width_ = width.empty() ? 0.f : *std::max_element(width.begin(), width.end());
    mean_width_ = width.empty() ? 0.f : float(sum / double(width.size()));
    width_ = std::move(width);
}

std::shared_ptr<const StrandRanks> Strands::ranks() const {
    std::call_once(ranks_->found, [&] { ranks_->ranks = ranks_of(*this); });
    return {ranks_, &ranks_->ranks};
}

void Strands::set_width(std::vector<float> width) {
    const auto held = lock();
    assign_width(std::move(width));
    revisions_.geometry = next_revision();
}

}  // namespace opacity
