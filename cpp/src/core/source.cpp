#include "opacity/core/source.hpp"

#include <atomic>

namespace opacity {

Revision next_revision() noexcept {
    static std::atomic<Revision> last{0};
    return ++last;
}

}  // namespace opacity
