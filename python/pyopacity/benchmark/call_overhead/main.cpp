// call_overhead DEVICE SEGMENTS REPEATS: prints microseconds, medians, as __main__.py beside it
// does: T at points, T at a shape, and, with DEVICE gpu, a picture; unchanged, then everything
// anew.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <opacity/opacity.hpp>
#include <string>
#include <vector>

namespace {

using namespace opacity;

template <class Work>
double median_us(int repeats, Work work) {
    std::vector<double> times;
    for (int i = 0; i < repeats + 2; ++i) {  // the first two warm up
        const auto begin = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::micro> taken =
            std::chrono::steady_clock::now() - begin;
        if (i > 1) times.push_back(taken.count());
    }
    std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
    return times[std::size_t(repeats) / 2];
}

void measure(Renderer& renderer, const Shape& shape, bool has_pictures, int repeats) {
    const Positions points = shape.points();
    std::vector<float> t(points.size()), rgba(4 * 64 * 64);
    const auto ask_points = [&] { renderer.transmittance(points, 0, t); };
    const auto ask_shape = [&] { renderer.transmittance(shape, 0, t); };
    const auto draw = [&] { renderer.render(rgba); };
    const auto anew = [&](auto work) {
        return [&renderer, work] { renderer.invalidate(), work(); };
    };
    const int few = std::max(repeats / 30, 9);
    std::printf("points %f\nshape %f\n", median_us(repeats, ask_points),
                median_us(repeats, ask_shape));
    std::printf("shape_anew %f\n", median_us(few, anew(ask_shape)));
    if (!has_pictures) return;
    std::printf("picture %f\n", median_us(repeats, draw));
    std::printf("picture_anew %f\n", median_us(few, anew(draw)));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    const bool on_gpu = std::string{argv[1]} == "gpu";
    auto scene = std::make_shared<Scene>();
    for (const ShapePtr& shape : load("demo:hair?segments=" + std::string{argv[2]}))
        scene->add(shape);
    scene->add(std::make_shared<DirectionalLight>(double3{0.5, 0.3, -0.8}));
    Renderer renderer = on_gpu ? Renderer{scene, Camera::fit(*scene)} : Renderer::on_cpu(scene);
    renderer.set_size(64, 64);
    measure(renderer, *scene->shapes()[0], on_gpu, std::atoi(argv[3]));
}
