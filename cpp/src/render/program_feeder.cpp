#include "render/program_feeder.hpp"

#include "gl/glsl_namespace.hpp"
#include "opacity/core/error.hpp"
#include "render/gl_device.hpp"

namespace opacity::render {

std::string ProgramFeeder::fed(std::string_view name) {
    std::string full = space_.empty() ? std::string{name} : gl::in_namespace(name, space_);
    fed_.insert(full);
    return full;
}

void ProgramFeeder::uniform(std::string_view name, const UniformValue& value) {
    program_.set(fed(name), value);
}

void ProgramFeeder::resource(const Resource& resource) {
    if (dynamic_cast<const Buffer*>(&resource)) {
        store(resource);
        return;
    }
    texture(resource.shader_name(), device_.images_.at(resource.name()).texture.name());
}

void ProgramFeeder::texture(const std::string& name, unsigned texture) {
    const std::string sampler = fed("t_" + name);
    if (const auto unit = program_.sampler(sampler))
        device_.gl().BindTextureUnit(GLuint(*unit), texture);
}

void ProgramFeeder::store(const Resource& resource) {
    if (dynamic_cast<const Buffer*>(&resource)) {
        buffer(resource.shader_name(), device_.buffers_.at(resource.name()).name());
        return;
    }
    const auto& texture = dynamic_cast<const Texture&>(resource);
    const std::string name = fed("i_" + resource.shader_name());
    const auto unit = program_.image(name);
    if (!unit) return;
    // The bits of floats, on which there are atomics, to a program that takes whole numbers.
    const bool as_bits = texture.desc().format == Format::r32f && program_.is_of_bits(name);
    device_.gl().BindImageTexture(GLuint(*unit), device_.images_.at(resource.name()).texture.name(),
                                  0, GL_TRUE, 0, GL_READ_WRITE,
                                  as_bits ? GL_R32UI : internal_format(texture.desc().format));
}

void ProgramFeeder::buffer(const std::string& name, unsigned buffer) {
    const std::string block = fed("b_" + name);
    if (const auto binding = program_.block(block))
        device_.gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, GLuint(*binding), buffer);
}

void ProgramFeeder::require_complete(const Pass& pass) const {
    std::string missing;
    const auto look = [&](const auto& inputs) {
        for (const auto& [name, place] : inputs)
            if (!fed_.contains(name)) missing += (missing.empty() ? "" : ", ") + name;
    };
    look(program_.uniforms());
    look(program_.samplers());
    look(program_.images());
    look(program_.blocks());
    if (missing.empty()) return;
    throw ShaderError(
        "pass \"" + pass.name + "\" uses " + missing + ", which no declared read feeds",
        "add the sources that feed them to .reads (or .stores) of the pass, or to what the look-up "
        "reads");
}

}  // namespace opacity::render
