// Meadows on bare soil, in centimetres: one that lets the soil through, and one that does not.
#include <algorithm>

#include "io/demo.hpp"
#include "io/demo_meadow.hpp"
#include "io/demo_triangles.hpp"

namespace opacity::demo {
namespace {

constexpr float3 soil{0.13f, 0.09f, 0.058f};

std::vector<ShapePtr> meadow_on_soil(const Meadow& meadow, const Request& request) {
    const double radius = meadow_radius(meadow, request.count);
    return {grass(meadow, request.count, request.seed),
            ground(4.0 * std::max(radius, meadow.height), soil)};
}

}  // namespace

std::vector<ShapePtr> grass(const Request& request) {
    return meadow_on_soil(
        {.blades_per_square_meter = 2200.0, .height = 24.0, .droop = 0.5, .straw = 0.1}, request);
}

std::vector<ShapePtr> dense_grass(const Request& request) {
    return meadow_on_soil(
        {.blades_per_square_meter = 12'000.0, .height = 30.0, .droop = 0.65, .straw = 0.05},
        request);
}

}  // namespace opacity::demo
