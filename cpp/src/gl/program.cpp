#include "gl/program.hpp"

#include <algorithm>
#include <utility>

#include "gl/check.hpp"
#include "gl/uniform_type.hpp"
#include "opacity/core/error.hpp"

namespace opacity::gl {
namespace {

const char* stage_define(GLenum stage) {
    switch (stage) {
        case GL_VERTEX_SHADER:
            return "STAGE_VERTEX";
        case GL_FRAGMENT_SHADER:
            return "STAGE_FRAGMENT";
        case GL_COMPUTE_SHADER:
            return "STAGE_COMPUTE";
        default:
            throw ShaderError("shader stage " + std::to_string(stage) + " is not supported",
                              "use a vertex and a fragment stage, or a compute stage");
    }
}

std::string log_of(const GladGLContext& gl, const ShaderObject& shader) {
    GLint length = 0;
    gl.GetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), '\0');
    gl.GetShaderInfoLog(shader.name(), length, &length, log.data());
    log.resize(std::size_t(length));
    return log;
}

std::string log_of(const GladGLContext& gl, const ProgramObject& program) {
    GLint length = 0;
    gl.GetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), '\0');
    gl.GetProgramInfoLog(program.name(), length, &length, log.data());
    log.resize(std::size_t(length));
    return log;
}

ShaderObject compile(const std::shared_ptr<Context>& context, const ShaderLibrary& library,
                     const Stage& stage, Defines defines, const Aliases& aliases,
                     const Namespaces& spaces) {
    defines.insert(defines.begin(), {stage_define(stage.stage), ""});
    const ExpandedShader expanded = library.expand(stage.path, defines, aliases, spaces);
    const GladGLContext& gl = context->gl();
    ShaderObject shader{context, stage.stage};
    const char* text = expanded.text.data();
    const auto length = GLint(expanded.text.size());
    gl.ShaderSource(shader.name(), 1, &text, &length);
    gl.CompileShader(shader.name());
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    const std::string log = expanded.with_file_names(log_of(gl, shader));
    if (!compiled) {
        throw ShaderError(stage.path + " did not compile:\n" + log,
                          "correct " + expanded.first_place(log));
    }
    if (!log.empty()) context->log(LogLevel::debug, stage.path + ": " + log);
    return shader;
}

GLint property(const GladGLContext& gl, GLuint program, GLenum interface, GLuint index,
               GLenum name) {
    GLint value = 0;
    gl.GetProgramResourceiv(program, interface, index, 1, &name, 1, nullptr, &value);
    return value;
}

GLint count_active(const GladGLContext& gl, GLuint program, GLenum interface) {
    GLint count = 0;
    gl.GetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    return count;
}

// As OpenGL lists it: an array is "u_weights[0]".
std::string listed_name(const GladGLContext& gl, GLuint program, GLenum interface, GLuint index) {
    std::string name(std::size_t(property(gl, program, interface, index, GL_NAME_LENGTH)), '\0');
    GLsizei length = 0;
    gl.GetProgramResourceName(program, interface, index, GLsizei(name.size()), &length,
                              name.data());
    name.resize(std::size_t(length));
    return name;
}

constexpr std::string_view array_mark = "[0]";

std::string declared_name(std::string listed) {
    if (listed.ends_with(array_mark)) listed.resize(listed.size() - array_mark.size());
    return listed;
}

}  // namespace

Program::Program(std::shared_ptr<Context> context, const ShaderLibrary& library,
                 const std::vector<Stage>& stages, const Defines& defines, const Aliases& aliases,
                 const Namespaces& spaces) {
    const Context::Use use{*context};
    const GladGLContext& gl = context->gl();
    object_ = ProgramObject{context};
    std::vector<ShaderObject> shaders;
    for (const Stage& stage : stages) {
        shaders.push_back(compile(context, library, stage, defines, aliases, spaces));
        gl.AttachShader(name(), shaders.back().name());
        label_ += (label_.empty() ? "" : " + ") + stage.path;
    }
    gl.LinkProgram(name());
    for (const ShaderObject& shader : shaders) gl.DetachShader(name(), shader.name());
    GLint linked = GL_FALSE;
    gl.GetProgramiv(name(), GL_LINK_STATUS, &linked);
    if (!linked) {
        throw ShaderError(label_ + " did not link:\n" + log_of(gl, object_),
                          "make what one stage writes and the next reads agree in name and type");
    }
    reflect_uniforms();
    reflect_blocks();
    check_errors(*context, "linking " + label_);
}

void Program::use() const {
    gl().UseProgram(name());
}

void Program::reflect_uniforms() {
    ByName<Uniform> opaque;
    const GLint count = count_active(gl(), name(), GL_UNIFORM);
    for (GLint i = 0; i < count; ++i) {
        const auto get = [&](GLenum what) {
            return property(gl(), name(), GL_UNIFORM, GLuint(i), what);
        };
        if (get(GL_BLOCK_INDEX) != -1) continue;
        const std::string listed = listed_name(gl(), name(), GL_UNIFORM, GLuint(i));
        if (listed.starts_with("gl_")) continue;  // state, which the driver feeds
        const Uniform uniform{get(GL_LOCATION), GLenum(get(GL_TYPE)), listed.ends_with(array_mark),
                              get(GL_ARRAY_SIZE)};
        auto& list = is_sampler(uniform.type) || is_image(uniform.type) ? opaque : uniforms_;
        list.emplace(declared_name(listed), uniform);
    }
    // By name, so that units do not depend on the driver's order.
    GLuint next_texture = 0, next_image = 0;
    for (const auto& [uniform_name, uniform] : opaque) {
        const bool image = is_image(uniform.type);
        GLuint& next = image ? next_image : next_texture;
        (image ? images_ : samplers_).emplace(uniform_name, next);
        if (is_bit_image(uniform.type)) bit_images_.insert(uniform_name);
        for (int element = 0; element < uniform.array_size; ++element) {
            gl().ProgramUniform1i(name(), uniform.location + element, GLint(next++));
        }
    }
}

void Program::reflect_blocks() {
    if (count_active(gl(), name(), GL_UNIFORM_BLOCK) > 0) {
        throw ShaderError(label_ + " has a uniform block, " +
                              listed_name(gl(), name(), GL_UNIFORM_BLOCK, 0) +
                              ", which nothing feeds",
                          "use plain uniforms, or a buffer block");
    }
    const GLint count = count_active(gl(), name(), GL_SHADER_STORAGE_BLOCK);
    for (GLint i = 0; i < count; ++i) {
        blocks_.emplace(listed_name(gl(), name(), GL_SHADER_STORAGE_BLOCK, GLuint(i)), GLuint(i));
        gl().ShaderStorageBlockBinding(name(), GLuint(i), GLuint(i));
    }
}

// ---- values ----

void Program::reject(std::string_view uniform, const Uniform& target, const std::string& given,
                     const std::string& fix) const {
    const std::string array = target.array ? "[" + std::to_string(target.array_size) + "]" : "";
    throw ShaderError(label_ + ": uniform " + uniform_type(target.type).name + " " +
                          std::string{uniform} + array + " was given " + given,
                      fix);
}

bool Program::set(std::string_view uniform, const UniformValue& value) {
    const auto found = uniforms_.find(uniform);
    if (found == uniforms_.end()) return false;
    const Context::Use use{*object_.context()};
    std::visit([&](const auto& alternative) { set_value(uniform, found->second, alternative); },
               value);
    return true;
}

void Program::set_value(std::string_view uniform, const Uniform& target, int value) {
    if (target.type == GL_INT && !target.array) {
        gl().ProgramUniform1i(name(), target.location, value);
    } else if (target.type == GL_UNSIGNED_INT && !target.array && value >= 0) {
        gl().ProgramUniform1ui(name(), target.location, GLuint(value));
    } else {
        reject(uniform, target, "the int " + std::to_string(value), "declare it as uniform int");
    }
}

void Program::set_value(std::string_view uniform, const Uniform& target, float value) {
    if (target.type != GL_FLOAT || target.array)
        reject(uniform, target, "one float", "declare it as uniform float");
    gl().ProgramUniform1f(name(), target.location, value);
}

void Program::set_value(std::string_view uniform, const Uniform& target, bool value) {
    if (target.type != GL_BOOL || target.array)
        reject(uniform, target, "one bool", "declare it as uniform bool");
    gl().ProgramUniform1i(name(), target.location, value);
}

void Program::set_value(std::string_view uniform, const Uniform& target,
                        const std::vector<float>& values) {
    const UniformType& type = uniform_type(target.type);
    const std::string given = std::to_string(values.size()) + " floats";
    if (!type.set_floats)
        reject(uniform, target, given, "declare it as vec2..4, mat3, mat4 or an array of floats");
    const auto components = std::size_t(type.components);
    const bool fits = target.array ? values.size() % components == 0 : values.size() == components;
    if (!fits)
        reject(uniform, target, given,
               "give " + std::to_string(components) + (target.array ? " for each element" : ""));
    std::vector<float> exact = values;
    exact.resize(components * std::size_t(target.array_size), 0.f);
    type.set_floats(gl(), name(), target.location, target.array_size, exact.data());
}

}  // namespace opacity::gl
