// What joins the registry while the program runs. These tests leave it as it was, as nothing that
// is registered ever leaves; tests/python/test_plugins.py does the rest.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "opacity/opacity.hpp"
#include "techniques/registry.hpp"

using namespace opacity;

namespace {

RegisteredTechnique named(const std::string& name) {
    return {.name = name, .shader = "", .make = [] { return make_technique("exact"); }};
}

}  // namespace

TEST_CASE("Registry: where one of several names is taken, none is registered") {
    const std::vector<std::string> before = technique_names();
    const Revision revision = registered_revision();
    CHECK_THROWS_AS(register_techniques({named("fresh"), named("exact")}), ParameterError);
    CHECK_THROWS_AS(register_techniques({named("fresh"), named("fresh")}), ParameterError);
    for (const char* name : {"", "Fresh", "1st", "a/b", "a b"})
        CHECK_THROWS_AS(register_techniques({named(name)}), ParameterError);
    CHECK(technique_names() == before);
    CHECK(registered_revision() == revision);
}

TEST_CASE("Plugin: a file that is none is an error, and not that of the search in system folders") {
    CHECK_THROWS_AS(load_plugin(""), PluginError);
    CHECK_THROWS_AS(load_plugin("libm.so.6"), PluginError);
    CHECK_THROWS_AS(load_plugin(OPACITY_SOURCE_DIR), PluginError);
    CHECK_THROWS_AS(load_plugin(OPACITY_SOURCE_DIR "/README.md"), PluginError);
}

TEST_CASE("Description: what is wrong with it is said with its name, before the registry changes") {
    const std::vector<std::string> before = technique_names();
    TechniqueDescription description{.name = "described",
                                     .summary = "A sum.",
                                     .paper = "none",
                                     .shader = "// PASS_total shadow_transmittance",
                                     .textures = {{.name = "total", .format = "rgba33f"}},
                                     .passes = {{.name = "total", .writes = {"total"}}},
                                     .look_up = {"total"}};
    try {
        register_technique(description);
        FAIL("the format does not exist");
    } catch (const ParameterError& error) {
        CHECK(error.problem() ==
              "described: texture \"total\": format = \"rgba33f\" does not exist");
        CHECK(error.fix().find("did you mean \"rgba32f\"") != std::string::npos);
    }
    description.name = "exact";
    description.textures.front().format = "rgba32f";
    CHECK_THROWS_AS(register_technique(description), ParameterError);
    CHECK(technique_names() == before);
}
