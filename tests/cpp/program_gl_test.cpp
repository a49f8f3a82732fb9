// Programs: messages that lead to the file, reflection, values that must match their type.
#include "gl/program.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "gl/buffer.hpp"
#include "gl/check.hpp"
#include "gl_context.hpp"
#include "opacity/core/error.hpp"

namespace gl = opacity::gl;

namespace {

constexpr const char* feeds_all = R"(
layout(local_size_x = 1) in;
layout(std430) buffer b_result { float result[]; };
layout(std430) readonly buffer b_input { float values[]; };
layout(r32f) uniform image2D i_map;
uniform sampler2D t_first;
uniform sampler2DArray t_second;
uniform float u_scale;
uniform int u_count;
uniform uint u_mask;
uniform bool u_on;
uniform vec3 u_axis;
uniform mat4 u_matrix;
uniform float u_weights[4];
uniform vec2 u_pairs[2];
uniform float u_unused;
void main() {
    float sum = u_scale + float(u_count) + float(u_mask) + (u_on ? 1000.0 : 0.0);
    for (int i = 0; i < u_count; ++i) sum += u_weights[i % 4] + u_pairs[i % 2].y;
    result[0] = sum;
    result[1] = (u_matrix * vec4(u_axis, 1.0)).x;
    result[2] = values[0] + texelFetch(t_first, ivec2(0), 0).x + texelFetch(t_second, ivec3(0), 0).x;
    imageStore(i_map, ivec2(0), vec4(1.0));
}
)";

gl::Program compute(const std::shared_ptr<gl::Context>& context, const std::string& text,
                    const gl::Defines& defines = {}) {
    gl::ShaderLibrary library;
    library.add("test/main.comp.glsl", text);
    library.add("test/part.glsl", "\nfloat part() { return missing_name; }\n");
    return {context, library, {{GL_COMPUTE_SHADER, "test/main.comp.glsl"}}, defines};
}

std::vector<float> run(const std::shared_ptr<gl::Context>& context, const gl::Program& program) {
    const gl::Context::Use use{*context};
    gl::Buffer result{context, 4 * sizeof(float)};
    const float seven = 7.f;
    gl::Buffer input{context, sizeof seven, &seven};
    program.use();
    context->gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, *program.block("b_result"),
                                 result.name());
    if (const auto block = program.block("b_input")) {
        context->gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, *block, input.name());
    }
    context->gl().DispatchCompute(1, 1, 1);
    context->gl().MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl::check_errors(*context, "running a test shader");
    std::vector<float> found(4);
    result.read(std::as_writable_bytes(std::span{found}));
    return found;
}

}  // namespace

TEST_CASE("a program lists what it wants, each with a place of its own") {
    const auto context = context_or_skip();
    if (!context) return;
    const gl::Program program = compute(context, feeds_all);
    CHECK(program.uniforms().size() == 8);
    CHECK_FALSE(program.uniforms().contains("u_unused"));
    CHECK(program.uniforms().at("u_weights").array);
    CHECK(program.samplers().size() == 2);
    CHECK(program.images().size() == 1);
    CHECK(program.blocks().size() == 2);
    REQUIRE(program.sampler("t_first"));
    REQUIRE(program.sampler("t_second"));
    CHECK(*program.sampler("t_first") != *program.sampler("t_second"));
    CHECK(*program.image("i_map") == 0u);
    CHECK(*program.block("b_input") != *program.block("b_result"));
    CHECK_FALSE(program.sampler("t_none"));
}

TEST_CASE("values arrive") {
    const auto context = context_or_skip();
    if (!context) return;
    gl::Program program = compute(context, feeds_all);
    CHECK(program.set("u_scale", 0.5f));
    CHECK(program.set("u_count", 4));
    CHECK(program.set("u_mask", 16));
    CHECK(program.set("u_on", true));
    CHECK(program.set("u_axis", std::vector<float>{1.f, 2.f, 3.f}));
    CHECK(program.set("u_weights", std::vector<float>{1.f, 2.f}));  // the other two become 0
    CHECK(program.set("u_pairs", std::vector<float>{0.f, 10.f, 0.f, 20.f}));
    std::vector<float> matrix(16, 0.f);
    matrix[4] = 2.f, matrix[12] = 100.f;  // by columns: x = 2 y + 100
    CHECK(program.set("u_matrix", matrix));
    CHECK_FALSE(program.set("u_unused", 1.f));
    const std::vector<float> found = run(context, program);
    CHECK(found[0] == 0.5f + 4.f + 16.f + 1000.f + 3.f + 60.f);
    CHECK(found[1] == 104.f);
    CHECK(found[2] == 7.f);
}

TEST_CASE("a value of another type is an error that names the uniform") {
    const auto context = context_or_skip();
    if (!context) return;
    gl::Program program = compute(context, feeds_all);
    CHECK_THROWS_WITH_AS(program.set("u_scale", 1), doctest::Contains("float u_scale"),
                         opacity::ShaderError);
    CHECK_THROWS_AS(program.set("u_count", 1.f), opacity::ShaderError);
    CHECK_THROWS_AS(program.set("u_count", true), opacity::ShaderError);
    CHECK_THROWS_AS(program.set("u_mask", -1), opacity::ShaderError);
    CHECK_THROWS_AS(program.set("u_axis", std::vector<float>(4)), opacity::ShaderError);
    CHECK_THROWS_AS(program.set("u_matrix", std::vector<float>(9)), opacity::ShaderError);
    CHECK_THROWS_AS(program.set("u_pairs", std::vector<float>(3)), opacity::ShaderError);
    CHECK_THROWS_AS(program.set("u_weights", 1.f), opacity::ShaderError);
    CHECK_THROWS_AS(program.set("u_count", std::vector<float>(1)), opacity::ShaderError);
}

TEST_CASE("a compiler's message names the file and the line") {
    const auto context = context_or_skip();
    if (!context) return;
    try {
        // The skipped branch's include must not shift the lines that follow it.
        compute(context,
                "layout(local_size_x = 1) in;\n"
                "#ifdef PASS_other\n#include \"test/part.glsl\"\n#endif\n"
                "void main() {\n    undeclared = 1;\n}\n");
        FAIL("compiled an error");
    } catch (const opacity::ShaderError& error) {
        CHECK(error.problem().find("test/main.comp.glsl:6") != std::string::npos);
        CHECK(error.fix().find("test/main.comp.glsl:6") != std::string::npos);
    }
    CHECK_THROWS_WITH_AS(
        compute(
            context,
            "layout(local_size_x = 1) in;\n#include \"test/part.glsl\"\nvoid main() { part(); }\n"),
        doctest::Contains("test/part.glsl:2"), opacity::ShaderError);
    CHECK(context->live_objects() == 0);
}

TEST_CASE("the second branch that includes a file has it when the first is skipped") {
    const auto context = context_or_skip();
    if (!context) return;
    gl::ShaderLibrary library;
    library.add("test/value.glsl", "float value() { return 3.0; }\n");
    library.add(
        "test/main.glsl",
        "layout(local_size_x = 1) in;\nlayout(std430) buffer b_result { float result[]; };\n"
        "#ifdef PASS_a\n#include \"test/value.glsl\"\nvoid main() { result[0] = value(); "
        "}\n#endif\n"
        "#ifdef PASS_b\n#include \"test/value.glsl\"\nvoid main() { result[0] = 2.0 * value(); "
        "}\n#endif\n");
    const std::vector<gl::Stage> stages = {{GL_COMPUTE_SHADER, "test/main.glsl"}};
    CHECK(run(context, {context, library, stages, {{"PASS_a", ""}}})[0] == 3.f);
    CHECK(run(context, {context, library, stages, {{"PASS_b", ""}}})[0] == 6.f);
}

TEST_CASE("stages see which one they are, and must agree") {
    const auto context = context_or_skip();
    if (!context) return;
    gl::ShaderLibrary library;
    library.add("test/both.glsl",
                "#ifdef STAGE_VERTEX\nvoid main() { gl_Position = vec4(0); }\n#endif\n"
                "#ifdef STAGE_FRAGMENT\nin vec3 v_missing;\nout vec4 o_color;\n"
                "void main() { o_color = vec4(v_missing, 1); }\n#endif\n");
    CHECK_THROWS_WITH_AS((gl::Program{context,
                                      library,
                                      {{GL_VERTEX_SHADER, "test/both.glsl"},
                                       {GL_FRAGMENT_SHADER, "test/both.glsl"}}}),
                         doctest::Contains("did not link"), opacity::ShaderError);
    CHECK(context->live_objects() == 0);
}

TEST_CASE("a uniform block is refused: nothing would feed it") {
    const auto context = context_or_skip();
    if (!context) return;
    CHECK_THROWS_WITH_AS(
        compute(
            context,
            "layout(local_size_x = 1) in;\nlayout(std430) buffer b_result { float result[]; };\n"
            "uniform Camera { float fov; };\nvoid main() { result[0] = fov; }\n"),
        doctest::Contains("Camera"), opacity::ShaderError);
}
