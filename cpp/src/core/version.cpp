#include "opacity/opacity.hpp"

namespace opacity {

const char* version() {
    return OPACITY_VERSION;
}

}  // namespace opacity
