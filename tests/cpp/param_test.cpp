#include <doctest/doctest.h>

#include <limits>

#include "opacity/core/error.hpp"
#include "opacity/core/list_param.hpp"
#include "opacity/core/nearest_name.hpp"
#include "opacity/core/param.hpp"

using namespace opacity;

namespace {

struct Owner : ParamOwner {
    Owner() : ParamOwner{"owner", "owner --help"} {}
    Param<int> layers{*this, "layers", 16, {1, 64}, "Layers."};
    Param<double> ratio{*this, "ratio", 0.5, {0.0, 1.0}, "Ratio."};
    Param<bool> fast{*this, "fast", true, "Fast."};
    Choice split{*this, "split", {"auto", "linear"}, "Split."};
    AutoParam<double> bias{*this, "bias", {0.0, 10.0}, "Bias."};
};

template <class Action>
std::string message_of(Action action) {
    try {
        action();
    } catch (const ParameterError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("a value outside the range names parameter, value and range, and changes nothing") {
    Owner owner;
    CHECK(message_of([&] { owner.layers.assign(std::int64_t{0}); }).find("owner --help lists") !=
          std::string::npos);
    const Revision before = owner.layers.revision();
    CHECK(message_of([&] {
              owner.layers.assign(std::int64_t{400});
          }).find("owner.layers = 400 is outside 1..64") == 0);
    CHECK_THROWS_AS(owner.layers.assign(0.0), ParameterError);
    CHECK_THROWS_AS(owner.layers.assign(2.5), ParameterError);
    CHECK_THROWS_AS(owner.layers.assign(true), ParameterError);
    CHECK_THROWS_AS(owner.layers.assign(std::string{"8"}), ParameterError);
    CHECK_THROWS_AS(owner.ratio.assign(std::numeric_limits<double>::quiet_NaN()), ParameterError);
    CHECK_THROWS_AS(owner.ratio.assign(std::numeric_limits<double>::infinity()), ParameterError);
    CHECK_THROWS_AS(owner.fast.assign(std::int64_t{1}), ParameterError);
    CHECK_THROWS_AS(owner.bias.assign(-1.0), ParameterError);
    CHECK_THROWS_AS(owner.bias.assign(std::string{"automatic"}), ParameterError);
    CHECK(message_of([&] {
              owner.split.assign(std::string{"log"});
          }).find("\"auto\", \"linear\"") != std::string::npos);
    CHECK(owner.layers.get() == 16);
    CHECK(owner.layers.revision() == before);
}

TEST_CASE("a refusal says whether the type or the value was wrong, and shows the value exactly") {
    Owner owner;
    const auto refusal = [&](ParamBase& param, const ParamValue& value) {
        const std::string message = message_of([&] { param.assign(value); });
        return message.substr(0, message.find('\n'));
    };
    CHECK(refusal(owner.layers, true) == "owner.layers = true is not an int");
    CHECK(refusal(owner.layers, 2.5) == "owner.layers = 2.5 is not an int");
    CHECK(refusal(owner.layers, 64.5) == "owner.layers = 64.5 is outside 1..64");
    CHECK(refusal(owner.ratio, std::string{"1"}) == "owner.ratio = \"1\" is not a float");
    CHECK(refusal(owner.ratio, 1.0000001) == "owner.ratio = 1.0000001 is outside 0..1");
    CHECK(refusal(owner.fast, std::int64_t{1}) == "owner.fast = 1 is not a bool");
    CHECK(refusal(owner.split, false) == "owner.split = false is not one of \"auto\", \"linear\"");
    CHECK(refusal(owner.bias, false) == "owner.bias = false is not a float or \"auto\"");
    CHECK(refusal(owner.bias, 11.0) == "owner.bias = 11 is outside 0..10");
}

TEST_CASE("numbers cross where nothing is lost, and the same value moves no revision") {
    Owner owner;
    owner.layers.assign(8.0);
    CHECK(owner.layers.get() == 8);
    owner.ratio.assign(std::int64_t{1});
    CHECK(owner.ratio.get() == 1.0);
    const Revision before = owner.layers.revision();
    owner.layers.assign(std::int64_t{8});
    CHECK(owner.layers.revision() == before);
    owner.bias.assign(std::int64_t{2});
    CHECK_FALSE(owner.bias.is_auto());
    owner.bias.assign(std::string{"auto"});
    CHECK(owner.bias.is_auto());
}

TEST_CASE("a list of numbers is written with commas, a word as it is") {
    ParamOwner owner{"owner", "nobody"};
    ListParam sizes{owner, "sizes", {"auto", "linear"}, "A list."};
    CHECK(sizes.is("auto"));
    sizes.assign(std::string{"1, 2.5,4"});
    CHECK(std::vector(sizes.numbers().begin(), sizes.numbers().end()) ==
          std::vector{1.0, 2.5, 4.0});
    sizes.assign(2.0);
    CHECK(sizes.numbers().size() == 1);
    sizes.assign(std::string{"linear"});
    CHECK(sizes.is("linear"));
    CHECK(sizes.numbers().empty());
    for (const char* wrong : {"", ",", "1,", "1,x", "0", "-1", "inf", "nan", "liner"})
        CHECK_THROWS_AS(sizes.assign(std::string{wrong}), ParameterError);
    CHECK_THROWS_AS(sizes.assign(true), ParameterError);
    CHECK(sizes.is("linear"));
}

TEST_CASE("both ends of every range are inside it") {
    Owner owner;
    for (int ends : {1, 64}) CHECK_NOTHROW(owner.layers.assign(std::int64_t{ends}));
    for (double ends : {0.0, 1.0}) CHECK_NOTHROW(owner.ratio.assign(ends));
}

TEST_CASE("a misspelt name suggests the nearest") {
    Owner owner;
    CHECK(message_of([&] { owner.param("layesr"); }).find("did you mean \"layers\"") !=
          std::string::npos);
    CHECK(&owner.param("split") == &owner.split);
    CHECK(nearest_name("boundig_opacity_maps", {"exact", "bounding_opacity_maps"}) ==
          "bounding_opacity_maps");
    CHECK(nearest_name("x", {}).empty());
}
