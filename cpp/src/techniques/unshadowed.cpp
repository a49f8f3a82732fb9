#include "techniques/unshadowed.hpp"

namespace opacity::techniques {

Reads Unshadowed::build(FrameGraph&, const ShadowInputs&) {
    return {};
}

}  // namespace opacity::techniques
