// What can be known to be wrong with a technique's description before a frame runs.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "opacity/core/error.hpp"
#include "opacity/core/nearest_name.hpp"
#include "techniques/description_words.hpp"
#include "techniques/registry.hpp"
#include "techniques/scripted_technique.hpp"

namespace opacity::techniques {
namespace {

constexpr int most_layers = 64, most_targets = 8;
constexpr double most_int = 2147483647.0;
// What lib/lookup.glsl and lib/deposit.glsl read by these names.
const std::set<std::string> engine_textures{"opaque_depth", "opaque_moved"};

std::string quoted(const std::string& word) {
    return "\"" + word + "\"";
}

std::string listed(const std::vector<std::string>& words) {
    std::string list;
    for (const std::string& word : words) list += (list.empty() ? "" : ", ") + quoted(word);
    return list.empty() ? "nothing" : list;
}

class Check {
   public:
    explicit Check(const TechniqueDescription& description) : d_{description} {}

    void all() {
        if (d_.summary.empty() || d_.paper.empty())
            fail("has no summary or no paper", "say in a sentence what it does, and where from");
        parameters();
        for (const TextureDescription& t : d_.textures) texture(t);
        for (const PassDescription& p : d_.passes) pass(p);
        for (const TextureDescription& t : d_.textures)
            if (!written_.contains(t.name))
                fail("texture " + quoted(t.name) + " is written by no pass",
                     "add it to the writes of one, or take it out");
        for (const std::string& name : d_.look_up) read("look_up", name);
        look_up_shader();
    }

   private:
    [[noreturn]] void fail(const std::string& problem, const std::string& fix) const {
        throw ParameterError(d_.name + ": " + problem, fix);
    }

    void new_word(const std::string& what, const std::string& name, std::set<std::string>& known) {
        if (!is_word(name))
            fail(what + " " + quoted(name) + " is no name for GLSL",
                 "name it by a-z, 0-9 and _, a letter first");
        if (!known.insert(name).second)
            fail(what + " " + quoted(name) + " is there twice, or every technique has it",
                 "choose another name");
    }

    template <class T>
    void one_of(const Words<T>& words, const std::string& field, const std::string& given) const {
        if (words.contains(given)) return;
        std::vector<std::string> names;
        for (const auto& [word, meaning] : words) names.push_back(word);
        fail(field + " = " + quoted(given) + " does not exist",
             "did you mean " + quoted(nearest_name(given, names)) + "? There are " + listed(names));
    }

    void parameters() {
        const ScriptedTechnique bare{std::make_shared<Script>(TechniqueDescription{d_.name})};
        for (const ParamBase* common : bare.params()) parameters_.insert(common->name());
        for (const ParamDescription& p : d_.parameters) {
            new_word("parameter", p.name, parameters_);
            if (p.doc.empty())
                fail("parameter " + quoted(p.name) + " has no doc", "say what it does");
            std::holds_alternative<std::string>(p.initial) ? choices(p) : range(p);
        }
    }

    void choices(const ParamDescription& p) const {
        const std::set<std::string> different{p.choices.begin(), p.choices.end()};
        if (p.choices.empty() || different.size() != p.choices.size() || different.contains(""))
            fail("parameter " + quoted(p.name) + " has the choices " + listed(p.choices),
                 "give it one word or more, all different, the default first");
    }

    void range(const ParamDescription& p) const {
        if (std::holds_alternative<bool>(p.initial)) return;
        const auto* whole = std::get_if<std::int64_t>(&p.initial);
        const double initial = whole ? double(*whole) : std::get<double>(p.initial);
        const auto [min, max] = p.range;
        const bool fits = std::isfinite(min) && std::isfinite(max) &&
                          (!whole || (min == std::floor(min) && max == std::floor(max) &&
                                      std::max(-min, max) <= most_int));
        if (!fits || !(min <= initial && initial <= max))
            fail("parameter " + quoted(p.name) + " = " + to_string(p.initial) + " with the range " +
                     to_string(ParamValue{min}) + ".." + to_string(ParamValue{max}),
                 "give it finite ends, whole ones where it is whole, and a default between them");
    }

    void texture(const TextureDescription& t) {
        new_word("texture", t.name, textures_);
        if (engine_textures.contains(t.name))
            fail("texture " + quoted(t.name) + " is the engine's own", "choose another name");
        one_of(format_words, "texture " + quoted(t.name) + ": format", t.format);
        if (t.layers < 0 || t.layers > most_layers)
            fail("texture " + quoted(t.name) + " has " + std::to_string(t.layers) + " layers",
                 "choose 0 for a plain one, or 1.." + std::to_string(most_layers));
        if (t.format == "depth32f" && t.layers > 0)
            fail("texture " + quoted(t.name) + " is a depth32f of layers",
                 "give it no layers: a pass has one depth target");
    }

    void pass(const PassDescription& p) {
        const std::string name = "pass " + quoted(p.name);
        new_word("pass", p.name, passes_);
        if (p.over != "casters" && p.over != "texels")
            fail(name + ": over = " + quoted(p.over) + " does not exist",
                 "choose \"casters\" or \"texels\"");
        one_of(depth_words, name + ": depth", p.depth);
        one_of(blend_words, name + ": blend", p.blend);
        for (const std::string& read_name : p.reads) read(name, read_name);
        if (p.writes.empty()) fail(name + " writes nothing", "name a texture in its writes");
        for (const std::string& texture : p.writes) write(name, texture);
        p.over == "casters" ? casters(p, name) : texels(p, name);
        const std::string stage = "PASS_" + p.name;
        if (p.fragment.empty() && d_.shader.find(stage) == std::string::npos)
            fail("shader has nothing for " + name, "put its main() into #ifdef " + stage);
    }

    void read(const std::string& where, const std::string& name) const {
        if (written_.contains(name)) return;
        if (textures_.contains(name))
            fail(where + " reads " + quoted(name) + ", which no pass before it writes",
                 "move the pass that writes it before, or take the name out");
        if (parameters_.contains(name)) return;
        std::vector<std::string> known{textures_.begin(), textures_.end()};
        for (const ParamDescription& p : d_.parameters) known.push_back(p.name);
        const std::string nearest = nearest_name(name, known);
        fail(where + " reads " + quoted(name) + ", which is no texture and no parameter of it",
             nearest.empty() ? "take it out: it has neither"
                             : "did you mean " + quoted(nearest) + "? It has " + listed(known));
    }

    void write(const std::string& where, const std::string& name) {
        if (!textures_.contains(name))
            fail(where + " writes " + quoted(name) + ", which is no texture of it",
                 "add it to the textures, or choose one of " +
                     listed({textures_.begin(), textures_.end()}));
        if (!written_.insert(name).second)
            fail(where + " writes " + quoted(name) + ", which a pass before it writes",
                 "one writer a texture: add a second texture");
    }

    const TextureDescription& described(const std::string& name) const {
        return *std::find_if(d_.textures.begin(), d_.textures.end(),
                             [&](const TextureDescription& t) { return t.name == name; });
    }

    void casters(const PassDescription& p, const std::string& name) const {
        int depths = 0, colors = 0;
        for (const std::string& written : p.writes) {
            const TextureDescription& t = described(written);
            if (t.format.ends_with("ui"))
                fail(name + " draws into " + quoted(t.name) + ", whose format is " + t.format,
                     "choose a format of floats, or write it over \"texels\"");
            (t.format == "depth32f" ? depths : colors) += std::max(1, t.layers);
        }
        if (depths > 1 || colors > most_targets)
            fail(name + " draws into " + std::to_string(depths) + " depth textures and " +
                     std::to_string(colors) + " layers of others",
                 "at most one and 8: spread them over several passes");
        if ((depths == 1) != (p.depth != "off"))
            fail(name + " has depth = " + quoted(p.depth) + " and " + std::to_string(depths) +
                     " depth32f textures to write",
                 "a depth test, \"less\" or \"greater\", goes with one depth32f texture");
    }

    void texels(const PassDescription& p, const std::string& name) const {
        if (!p.fragment.empty() || p.depth != "off" || p.blend != "off")
            fail(name + " is over texels and has a fragment, a depth or a blend",
                 "take these out, or draw it over \"casters\"");
        for (const std::string& written : p.writes)
            if (described(written).format == "depth32f")
                fail(name + " stores into " + quoted(written) + ", which is a depth32f",
                     "choose the format r32f");
    }

    void look_up_shader() const {
        for (const char* entry : {"texel_optical_depth", "shadow_transmittance"})
            if (d_.shader.find(entry) != std::string::npos) return;
        fail("shader has no look-up",
             "define float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) and "
             "#include \"lib/lookup.glsl\" behind it, or float shadow_transmittance(Receiver "
             "receiver)");
    }

    const TechniqueDescription& d_;
    std::set<std::string> parameters_, textures_, passes_, written_;
};

}  // namespace

void check(const TechniqueDescription& description) {
    if (is_word(description.name)) Check{description}.all();  // else the registry says it
}

}  // namespace opacity::techniques
