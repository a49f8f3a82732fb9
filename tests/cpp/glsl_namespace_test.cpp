#include "gl/glsl_namespace.hpp"

#include <doctest/doctest.h>

using opacity::gl::in_namespace;
using opacity::gl::text_in_namespace;

namespace {

void check_renamed(const char* text, const char* expected) {
    CHECK(text_in_namespace(text, "camera") == expected);
}

}  // namespace

TEST_CASE("a name in a namespace keeps the letter of its kind in front") {
    CHECK(in_namespace("u_layers", "camera") == "u_camera_layers");
    CHECK(in_namespace("Receiver", "camera") == "camera_Receiver");
    CHECK(in_namespace("t_start", "camera") == "t_camera_start");
}

TEST_CASE(
    "what a text declares at file scope is in the namespace, what it takes from elsewhere not") {
    check_renamed("uniform float u_a[65], u_b;\nconst vec3 c = vec3(1.0, 2.0, 3.0), d = c;\n",
                  "uniform float u_camera_a[65], u_camera_b;\n"
                  "const vec3 camera_c = vec3(1.0, 2.0, 3.0), camera_d = camera_c;\n");
    check_renamed(
        "float f(float x) { float y = x; return max(y, other(x)); }\nfloat g() { return f(1e5); }",
        "float camera_f(float x) { float y = x; return max(y, other(x)); }\n"
        "float camera_g() { return camera_f(1e5); }");
    check_renamed("layout(local_size_x = 64) in;", "layout(local_size_x = 64) in;");
}

TEST_CASE("members keep their names, and members of unnamed blocks do not") {
    check_renamed("struct S { vec3 f, g; float h; };\nfloat f(S s) { return s.f.x * s.h; }",
                  "struct camera_S { vec3 f, g; float h; };\n"
                  "float camera_f(camera_S s) { return s.f.x * s.h; }");
    check_renamed(
        "layout(std430) readonly buffer b_points { vec4 points[]; };\nvec4 p() { return points[0]; "
        "}",
        "layout(std430) readonly buffer b_camera_points { vec4 camera_points[]; };\n"
        "vec4 camera_p() { return camera_points[0]; }");
}

TEST_CASE("symbols of conditions are in the namespace, comments are left alone") {
    check_renamed("// f is f\n#if defined(FAST) && !defined(SLOW)\nfloat f[FAST];\n#endif\n",
                  "// f is f\n#if defined(camera_FAST) && !defined(camera_SLOW)\n"
                  "float camera_f[camera_FAST];\n#endif\n");
}
