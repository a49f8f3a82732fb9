// Finds the primitives whose boxes a ray meets. What is crossed there is not its business.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rays/casters.hpp"
#include "rays/hits.hpp"
#include "rays/pieces.hpp"

namespace opacity::rays {

class Backend {
   public:
    virtual ~Backend() = default;
    // Offers `hits` each primitive whose box its ray meets within reach. Called on many threads.
    virtual void search(Hits& hits, const Reach& reach) const = 0;
};

// Asked now and then during a long build; true has it end early, with a backend of no use.
using Stop = std::function<bool()>;

std::unique_ptr<Backend> build_builtin(const Casters& casters, const Stop& stop);
// Null in a build without Embree.
std::unique_ptr<Backend> build_embree(const Casters& casters, const Stop& stop);
bool has_embree();

}  // namespace opacity::rays
