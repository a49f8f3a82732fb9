#include "map/filter.hpp"

#include <array>
#include <utility>

#include "opacity/core/error.hpp"

namespace opacity {

FilterKernel filter_kernel(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, FilterKernel>, 5> kernels{
        {{"none", FilterKernel::none},
         {"box", FilterKernel::box},
         {"bartlett", FilterKernel::bartlett},
         {"gaussian", FilterKernel::gaussian},
         {"pcf", FilterKernel::pcf}}};
    for (const auto& [known, kernel] : kernels)
        if (known == name) return kernel;
    throw ParameterError("there is no filter \"" + std::string{name} + "\" in C++",
                         "add it to filter_kernel in map/filter.cpp");
}

}  // namespace opacity
