#include "core/number_text.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <limits>

using namespace opacity;

TEST_CASE("a number in a message is short, and reads back as itself") {
    CHECK(number_text(1.0) == "1");
    CHECK(number_text(-0.5) == "-0.5");
    CHECK(number_text(100000.0) == "100000");
    CHECK(number_text(1234567.5) == "1234567.5");
    CHECK(number_text(1.0000001) == "1.0000001");
    CHECK(number_text(1e18) == "1e+18");
    CHECK(number_text(0.1f) == "0.1");
    CHECK(number_text(std::numeric_limits<double>::infinity()) == "inf");
    CHECK(number_text(std::numeric_limits<double>::quiet_NaN()) == "nan");
    using Limits = std::numeric_limits<double>;
    for (const double value : {0.1, -1.0 / 3.0, 1e-4, 0.99e-4, 1e15, 999999999999999.9,
                               -Limits::max(), Limits::min(), Limits::denorm_min()})
        CHECK(std::strtod(number_text(value).c_str(), nullptr) == value);
    using Floats = std::numeric_limits<float>;
    for (const float value : {0.1f, -1.f / 3.f, 1e15f, Floats::max(), Floats::denorm_min()})
        CHECK(std::strtof(number_text(value).c_str(), nullptr) == value);
}
