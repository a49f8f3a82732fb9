// Hands a pass's declared sources to a program, and holds the pass to its declarations: whatever
// the program takes and no declared source feeds is an error that names the line to add.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "gl/program.hpp"
#include "opacity/graph/pass.hpp"

namespace opacity::render {

class GlDevice;

class ProgramFeeder : public Feeder {
   public:
    ProgramFeeder(const GlDevice& device, gl::Program& program)
        : device_{device}, program_{program} {}

    // What is fed from now on is meant for names in a namespace of the shader; empty: in none.
    void set_space(std::string space) { space_ = std::move(space); }
    void uniform(std::string_view name, const UniformValue& value) override;
    void resource(const Resource& resource) override;
    // A texture that the pass writes as an image, or a buffer.
    void store(const Resource& resource);
    // A buffer b_<name> of the shape that is drawn.
    void buffer(const std::string& name, unsigned buffer);
    // A texture t_<name> of it.
    void texture(const std::string& name, unsigned texture);
    // ShaderError when the program has an input that was not fed.
    void require_complete(const Pass& pass) const;

   private:
    // The name as it stands in the program; noted as fed.
    std::string fed(std::string_view name);

    const GlDevice& device_;
    gl::Program& program_;
    std::string space_;
    std::set<std::string> fed_;
};

}  // namespace opacity::render
