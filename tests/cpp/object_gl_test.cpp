// Textures and buffers: what dies when, and what does not fit.
#include "gl/object.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <span>
#include <thread>
#include <vector>

#include "gl/buffer.hpp"
#include "gl/texture.hpp"
#include "gl_context.hpp"
#include "opacity/core/error.hpp"

namespace gl = opacity::gl;

TEST_CASE("objects are counted, and may die on a foreign thread") {
    const auto context = context_or_skip();
    if (!context) return;
    auto buffer = std::make_unique<gl::Buffer>(context, 1024);
    auto texture = std::make_unique<gl::Texture>(context, GL_TEXTURE_2D_ARRAY, GL_RGBA32F, 8, 8, 4);
    const GLuint name = buffer->name();
    CHECK(context->live_objects() == 2);
    std::thread{[&] { buffer.reset(), texture.reset(); }}.join();
    CHECK(context->live_objects() == 0);
    const gl::Context::Use use{*context};
    CHECK_FALSE(context->gl().IsBuffer(name));
}

TEST_CASE("an object keeps its context, and both may die on a foreign thread") {
    auto context = context_or_skip();
    if (!context) return;
    auto texture = std::make_unique<gl::Texture>(context, GL_TEXTURE_2D, GL_R32F, 4, 4);
    context.reset();
    std::thread{[&] { texture.reset(); }}.join();
    CHECK(context_or_skip());
}

TEST_CASE("an object dies at once on its own thread, used or not") {
    const auto context = context_or_skip();
    if (!context) return;
    GLuint name = 0;
    {
        const gl::Buffer buffer{context, 16};
        name = buffer.name();
    }
    const gl::Context::Use use{*context};
    CHECK_FALSE(context->gl().IsBuffer(name));
}

TEST_CASE("content survives the way to the GPU and back") {
    const auto context = context_or_skip();
    if (!context) return;
    std::vector<float> texels(3 * 5 * 2);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = 0.1f * float(i);
    gl::Texture texture{context, GL_TEXTURE_2D_ARRAY, GL_R32F, 3, 5, 2};
    texture.write(std::as_bytes(std::span{texels}));
    std::vector<float> found(texels.size());
    texture.read(std::as_writable_bytes(std::span{found}));
    CHECK(found == texels);
    texture.clear();
    texture.read(std::as_writable_bytes(std::span{found}));
    CHECK(found == std::vector<float>(texels.size()));

    gl::Buffer buffer{context, 12, texels.data()};
    buffer.write(std::as_bytes(std::span{texels}.subspan(5, 1)), 4);
    float three[3] = {};
    buffer.read(std::as_writable_bytes(std::span{three}));
    CHECK(three[0] == texels[0]);
    CHECK(three[1] == texels[5]);
    CHECK(three[2] == texels[2]);
}

TEST_CASE("what does not fit is a typed error with its size") {
    const auto context = context_or_skip();
    if (!context) return;
    CHECK_THROWS_WITH_AS((gl::Texture{context, GL_TEXTURE_2D, GL_R32F, 1 << 20, 4}),
                         doctest::Contains("1048576 x 4"), opacity::ParameterError);
    CHECK_THROWS_AS((gl::Texture{context, GL_TEXTURE_2D, GL_R32F, 0, 4}), opacity::ParameterError);
    // 8 TiB: more than any device has.
    CHECK_THROWS_WITH_AS(
        (gl::Texture{context, GL_TEXTURE_2D_ARRAY, GL_RGBA32F, 16384, 16384, 2048}),
        doctest::Contains("8.0 TiB"), opacity::OutOfMemoryError);
    CHECK_THROWS_WITH_AS((gl::Buffer{context, std::size_t{1} << 46}), doctest::Contains("64.0 TiB"),
                         opacity::OutOfMemoryError);
    CHECK(context->live_objects() == 0);
    CHECK(render_one_texel(context, 0.75f) == 0.75f);
}
