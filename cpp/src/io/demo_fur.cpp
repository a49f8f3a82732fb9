// A furry animal: a rabbit that sits on the ground, in centimetres.
#include "io/demo.hpp"
#include "io/demo_rabbit.hpp"
#include "io/demo_triangles.hpp"

namespace opacity::demo {

std::vector<ShapePtr> fur(const Request& request) {
    const std::shared_ptr<Mesh> body = rabbit();
    return {coat(*body, request, rabbit_fur), body, rabbit_eyes(),
            ground(90.0, {0.42f, 0.45f, 0.36f})};
}

}  // namespace opacity::demo
