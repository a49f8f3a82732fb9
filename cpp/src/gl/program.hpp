// A linked program and what it wants to be fed: after linking, every active uniform,
// sampler, image and storage block has a name here, and a unit or binding of its own.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gl/object.hpp"
#include "gl/shader_library.hpp"

namespace opacity::gl {

struct Stage {
    GLenum stage;  // GL_VERTEX_SHADER, GL_FRAGMENT_SHADER, GL_COMPUTE_SHADER
    std::string path;
};

// An active uniform outside blocks that is no sampler or image.
struct Uniform {
    GLint location;
    GLenum type;
    bool array;
    int array_size;  // as far as the linker kept it; 1 where it is no array
};

class Program {
   public:
    // Every stage also sees STAGE_VERTEX, STAGE_FRAGMENT or STAGE_COMPUTE.
    // ShaderError with the compiler's messages, which name "file:line".
    Program(std::shared_ptr<Context> context, const ShaderLibrary& library,
            const std::vector<Stage>& stages, const Defines& defines = {},
            const Aliases& aliases = {}, const Namespaces& spaces = {});

    GLuint name() const noexcept { return object_.name(); }
    void use() const;

    // False where the program has no such active uniform. A float vector fills a vec2..4, a mat3
    // or mat4 by columns, or an array, whose missing elements become 0 and whose surplus is
    // dropped, as the linker drops what is never read. ShaderError where the types do not match.
    bool set(std::string_view uniform, const UniformValue& value);

    // The texture unit, image unit or binding; none where it is not active.
    std::optional<GLuint> sampler(std::string_view name) const { return find(samplers_, name); }
    std::optional<GLuint> image(std::string_view name) const { return find(images_, name); }
    std::optional<GLuint> block(std::string_view name) const { return find(blocks_, name); }
    // Whether an image is of unsigned whole numbers.
    bool is_of_bits(std::string_view image) const { return bit_images_.contains(image); }

    // All that is active, by name: what a caller has not fed is an error that it can report.
    template <class T>
    using ByName = std::map<std::string, T, std::less<>>;
    const ByName<Uniform>& uniforms() const noexcept { return uniforms_; }
    const ByName<GLuint>& samplers() const noexcept { return samplers_; }
    const ByName<GLuint>& images() const noexcept { return images_; }
    const ByName<GLuint>& blocks() const noexcept { return blocks_; }

   private:
    static std::optional<GLuint> find(const ByName<GLuint>& names, std::string_view name) {
        const auto found = names.find(name);
        return found == names.end() ? std::nullopt : std::optional{found->second};
    }
    const GladGLContext& gl() const { return object_.context()->gl(); }

    void reflect_uniforms();
    void reflect_blocks();
    [[noreturn]] void reject(std::string_view uniform, const Uniform& target,
                             const std::string& given, const std::string& fix) const;
    void set_value(std::string_view uniform, const Uniform& target, int value);
    void set_value(std::string_view uniform, const Uniform& target, float value);
    void set_value(std::string_view uniform, const Uniform& target, bool value);
    void set_value(std::string_view uniform, const Uniform& target,
                   const std::vector<float>& values);

    ProgramObject object_;
    std::string label_;  // "casters.vert.glsl + techniques/exact.glsl"
    ByName<Uniform> uniforms_;
    ByName<GLuint> samplers_, images_, blocks_;
    std::set<std::string, std::less<>> bit_images_;
};

}  // namespace opacity::gl
