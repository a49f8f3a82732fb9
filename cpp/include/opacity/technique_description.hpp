// A technique as data: what it draws into which textures, what its look-up reads, and the text of
// its shader. It needs no compiler, since it may come from Python or a file: what is one of several
// is a word.
#pragma once

#include <string>
#include <vector>

#include "opacity/core/param.hpp"

namespace opacity {

// In GLSL u_<name>: of choices the index.
struct ParamDescription {
    std::string name;
    ParamValue initial;                     // its type is the parameter's; of choices the first
    Range<double> range = {0.0, 1.0};       // of numbers
    std::vector<std::string> choices = {};  // of words
    std::string doc = {};
};

// As large as the light's maps. In GLSL t_<name>, where a texel pass writes it i_<name>.
struct TextureDescription {
    std::string name;
    std::string format = "rgba32f";  // or depth32f, r32f, rgba16f, rgba8, r32ui, rgba32ui
    int layers = 0;                  // 0: a plain texture; otherwise an array of at most 64
};

struct PassDescription {
    std::string name;
    std::vector<std::string> writes;      // textures: targets in this order, an array by its layers
    std::vector<std::string> reads = {};  // textures of passes before it, and parameters
    // Draws the casters, or computes: an invocation of the technique's shader for each texel of the
    // textures that it writes, layer by layer (lib/invocation.glsl).
    std::string over = "casters";  // or texels
    // Over casters: the technique's shader under PASS_<name>, or one of the engine's files.
    std::string fragment = {};
    bool optical_depth = true;  // it asks for more than where casters lie
    std::string depth = "off";  // less: the nearest to the light remains; greater: the farthest
    std::string blend = "off";  // add: of all fragments the sum
};

struct TechniqueDescription {
    std::string name = {};
    std::string summary = {}, paper = {};
    std::string shader = {};  // as techniques/<name>.glsl: all stages, and the look-up
    std::vector<ParamDescription> parameters = {};
    std::vector<TextureDescription> textures = {};
    std::vector<PassDescription> passes = {};
    std::vector<std::string> look_up = {};  // textures and parameters that it reads
    bool own_correction = false;            // it also wants to know what the receiver itself casts
};

// Registers it under its name, in the place of what was described under the same one.
// ParameterError that names the field: a name that is no word, or is not known where it is read; a
// texture that no pass writes; a format, a test or a range that does not exist; a name that belongs
// to the engine or to a plugin. ShaderError for an #include that does not exist; what a compiler
// finds is one of the first frame.
void register_technique(TechniqueDescription description);

}  // namespace opacity
