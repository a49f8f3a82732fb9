// What load_plugin refuses, one fault for each FAULT_<name>.

#if defined(FAULT_no_entry)

int nothing_of_interest = 0;

#elif defined(FAULT_other_headers)

// Of an engine whose Plugin may look like anything behind its first member.
extern "C" const void* opacity_plugin() {
    static const char* const plugin[] = {"9.9.9 (headers of tomorrow)"};
    return plugin;
}

#else
#include <opacity/plugin.hpp>

namespace {

using namespace opacity;

class Nothing : public Technique {
   public:
    Nothing() : Technique{"nothing"} {}
    std::string_view summary() const override { return "No shadow."; }
    std::string_view paper() const override { return "none"; }
    LookUp build(FrameGraph&, const ShadowInputs&) override { return {}; }
};

[[maybe_unused]] Revision count_apart() {
    return 1;
}
[[maybe_unused]] std::unique_ptr<Technique> make_none() {
    return nullptr;
}

}  // namespace

#if defined(FAULT_other_engine)
extern "C" const Plugin* opacity_plugin() {
    static const PluginTechnique technique{"nothing", "", plugin_technique<Nothing>};
    static const Plugin plugin{OPACITY_INTERFACE, &count_apart, &technique, 1};
    return &plugin;
}
#elif defined(FAULT_taken_name)
OPACITY_PLUGIN({"nothing", "", plugin_technique<Nothing>}, {"exact", "", plugin_technique<Nothing>})
#elif defined(FAULT_false_names)
OPACITY_PLUGIN({"something", "", plugin_technique<Nothing>}, {"none", "", make_none})
#endif
#endif
