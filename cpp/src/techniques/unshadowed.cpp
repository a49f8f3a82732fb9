#include "techniques/unshadowed.hpp"

namespace opacity::techniques {

LookUp Unshadowed::build(FrameGraph&, const ShadowInputs&) {
    return {};
}

}  // namespace opacity::techniques
