// What the tests of the conventions share: GLSL evaluated row by row by a small compute shader, and
// the comparison with what C++ makes of the same floats.
#pragma once

#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gl/buffer.hpp"
#include "gl/check.hpp"
#include "gl/program.hpp"
#include "gl/shader_library.hpp"
#include "gl_context.hpp"

namespace harness {

using Row = std::vector<float>;
using Table = std::vector<Row>;

// `body` takes given(0), given(1) .. and sets result(0) ..; `declarations` stand before main.
struct Shader {
    std::string declarations;
    int inputs, outputs;
    std::string body;
    opacity::gl::Defines defines = {};
};

// How far the last evaluator's device may round from C++: GPUs fuse a * b + c into one rounding.
inline double device_rounding = 1e-6;

class Evaluator {
   public:
    Evaluator(std::shared_ptr<opacity::gl::Context> context, const Shader& shader)
        : context_{std::move(context)},
          inputs_{shader.inputs},
          outputs_{shader.outputs},
          program_{context_,
                   library_with(text_of(shader)),
                   {{GL_COMPUTE_SHADER, "test/evaluate.comp.glsl"}},
                   shader.defines} {
        device_rounding = context_->is_software() ? 1e-6 : 5e-6;
    }

    opacity::gl::Program& program() { return program_; }
    // A map of one channel, for the sampler of that name.
    void set_map(const std::string& sampler, int size_px, const std::vector<float>& texels) {
        const opacity::gl::Context::Use use{*context_};
        opacity::gl::Texture& map =
            maps_.emplace_back(context_, GL_TEXTURE_2D, GL_R32F, size_px, size_px);
        map.write(std::as_bytes(std::span{texels}));
        if (const auto unit = program_.sampler(sampler))
            context_->gl().BindTextureUnit(*unit, map.name());
    }

    // Any texture, for the sampler of that name.
    void set_texture(const std::string& sampler, opacity::gl::Texture texture) {
        const opacity::gl::Context::Use use{*context_};
        maps_.push_back(std::move(texture));
        if (const auto unit = program_.sampler(sampler))
            context_->gl().BindTextureUnit(*unit, maps_.back().name());
    }

    Table operator()(const Table& rows) {
        const opacity::gl::Context::Use use{*context_};
        std::vector<float> given;
        for (const Row& row : rows) given.insert(given.end(), row.begin(), row.end());
        REQUIRE(given.size() == rows.size() * inputs_);
        opacity::gl::Buffer input{context_, given.size() * sizeof(float), given.data()};
        std::vector<float> found(rows.size() * outputs_);
        opacity::gl::Buffer output{context_, found.size() * sizeof(float)};
        program_.set("u_count", int(rows.size()));
        program_.use();
        const GladGLContext& gl = context_->gl();
        const auto bind = [&](const char* block, const opacity::gl::Buffer& buffer) {
            gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, *program_.block(block), buffer.name());
        };
        bind("b_given", input);
        bind("b_found", output);
        gl.DispatchCompute(GLuint((rows.size() + 63) / 64), 1, 1);
        gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        opacity::gl::check_errors(*context_, "evaluating a test shader");
        output.read(std::as_writable_bytes(std::span{found}));
        Table result;
        for (std::size_t i = 0; i < found.size(); i += outputs_)
            result.emplace_back(found.begin() + i, found.begin() + i + outputs_);
        return result;
    }

   private:
    static std::string text_of(const Shader& shader) {
        return "#include \"lib/invocation.glsl\"\n" + shader.declarations +
               "\nlayout(std430) readonly buffer b_given { float given_values[]; };\n"
               "layout(std430) writeonly buffer b_found { float found_values[]; };\n"
               "uniform int u_count;\n"
               "#define given(i) given_values[row * " +
               std::to_string(shader.inputs) +
               "u + uint(i)]\n"
               "#define given2(i) vec2(given(i), given(i + 1))\n"
               "#define given3(i) vec3(given2(i), given(i + 2))\n"
               "#define result(i) found_values[row * " +
               std::to_string(shader.outputs) +
               "u + uint(i)]\n"
               "void main() {\n"
               "    uint row = invocation_index();\n"
               "    if (row >= uint(u_count)) return;\n" +
               shader.body + "\n}\n";
    }
    static opacity::gl::ShaderLibrary library_with(const std::string& text) {
        opacity::gl::ShaderLibrary library;
        library.add("test/evaluate.comp.glsl", text);
        return library;
    }

    std::shared_ptr<opacity::gl::Context> context_;
    int inputs_, outputs_;
    opacity::gl::Program program_;
    std::vector<opacity::gl::Texture> maps_;
};

inline std::string text_of(const Row& row) {
    std::ostringstream text;
    text.precision(9);
    for (const float value : row) text << value << " ";
    return text.str();
}

// Absolute up to 1, relative above; infinite where one side is not a number.
inline double difference(float found, float expected) {
    if (found == expected) return 0.0;
    const double d = std::abs(double(found) - double(expected));
    return std::isfinite(d) ? d / std::max(1.0, std::abs(double(expected))) : INFINITY;
}

// Each number of each row, as `difference` says; the message shows the worst row.
template <class Expected>
void check_agreement(const Table& given, const Table& found, Expected expected,
                     double tolerance = device_rounding) {
    REQUIRE(found.size() == given.size());
    double worst = 0.0;
    std::size_t worst_row = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const Row wanted = expected(given[i]);
        REQUIRE(wanted.size() == found[i].size());
        for (std::size_t k = 0; k < wanted.size(); ++k)
            if (const double d = difference(found[i][k], wanted[k]); d > worst)
                worst = d, worst_row = i;
    }
    CHECK_MESSAGE(worst <= tolerance, "worst ", worst, " for ", text_of(given[worst_row]),
                  "\n  GLSL ", text_of(found[worst_row]), "\n  C++  ",
                  text_of(expected(given[worst_row])));
}

class Random {
   public:
    explicit Random(unsigned seed = 1) : engine_{seed} {}
    float operator()(float low, float high) {
        return low + (high - low) * (float(engine_() >> 8) / 16777216.f);
    }
    int below(int count) { return int(engine_() % unsigned(count)); }

   private:
    std::mt19937 engine_;
};

}  // namespace harness
