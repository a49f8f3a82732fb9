// A furry animal: a rabbit that sits on the ground, in centimetres.
#include "io/demo.hpp"
#include "io/demo_rabbit.hpp"
#include "io/demo_triangles.hpp"

namespace opacity::demo {

std::vector<ShapePtr> fur(const Request& request) {
    constexpr std::size_t usual = 400'000;
    const std::shared_ptr<Mesh> body = rabbit();
    const double width = 0.045 * size_for(request.count, usual, 0.2, 3.0);
    auto strands = coat(*body, request.count, request.seed,
                        [&](const glm::dvec3& point, const glm::dvec3& normal) {
                            Lie lie = rabbit_fur(point, normal);
                            lie.width = width;
                            return lie;
                        });
    return {std::move(strands), body, rabbit_eyes(), ground(90.0, {0.42f, 0.45f, 0.36f})};
}

}  // namespace opacity::demo
