#include "viewer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace opacity::demo {
namespace {

constexpr double degrees_per_pixel = 0.4;

// `v` turned about `axis` (of length 1), after Rodrigues.
double3 turned(const double3& v, const double3& axis, double degrees) {
    const double angle = degrees * 3.14159265358979 / 180.0, c = std::cos(angle),
                 s = std::sin(angle);
    const double along = (1.0 - c) * (v[0] * axis[0] + v[1] * axis[1] + v[2] * axis[2]);
    const double3 cross{axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
                        axis[0] * v[1] - axis[1] * v[0]};
    double3 result;
    for (int i = 0; i < 3; ++i) result[i] = c * v[i] + s * cross[i] + along * axis[i];
    return result;
}

// `direction` after a drag: sideways about `up`, and up or down as far as it stays off the pole.
double3 dragged(const double3& direction, const double3& up, double dx, double dy) {
    const double3 sideways = turned(direction, up, -dx * degrees_per_pixel);
    double3 right{sideways[1] * up[2] - sideways[2] * up[1],
                  sideways[2] * up[0] - sideways[0] * up[2],
                  sideways[0] * up[1] - sideways[1] * up[0]};
    const double length = std::hypot(right[0], right[1], right[2]);
    if (length < 1e-9) return sideways;
    for (double& component : right) component /= length;
    const double3 result = turned(sideways, right, -dy * degrees_per_pixel);
    const double to_pole = std::abs(result[0] * up[0] + result[1] * up[1] + result[2] * up[2]);
    return to_pole > 0.995 * std::hypot(result[0], result[1], result[2]) ? sideways : result;
}

// A direction of a world whose z points up, in one whose y does.
double3 z_to_y(const double3& v) {
    return {v[0], v[2], -v[1]};
}

}  // namespace

Camera Stage::camera(double distance_factor) const {
    const Camera fitted = Camera::fit(casters, view_direction, up, 35.0);
    double3 eye = fitted.eye();
    for (int i = 0; i < 3; ++i)
        eye[i] = fitted.target()[i] + distance_factor * (eye[i] - fitted.target()[i]);
    return Camera::look_at(eye, fitted.target(), up, fitted.fov_deg());
}

Stage load_stage(const Options& options) {
    Stage stage{std::make_shared<Scene>(), nullptr, {}, {0.3, 1.0, -0.25}, {0, 0, 1}};
    double3 light = options.light.value_or(double3{0.5, 0.3, -0.8});
    if (options.y_up) {
        stage.view_direction = z_to_y(stage.view_direction);
        stage.up = {0, 1, 0};
        if (!options.light) light = z_to_y(light);
    }
    const Logger log = [](LogLevel, std::string_view message) {
        std::fprintf(stderr, "opacity_demo: %.*s\n", int(message.size()), message.data());
    };
    for (const std::string& file : options.files)
        for (const ShapePtr& shape : load(file, log)) {
            stage.scene->add(shape);
            if (shape->casts()) stage.casters.extend(shape->bounds());
        }
    stage.light = std::make_shared<DirectionalLight>(light);
    stage.scene->add(LightPtr{stage.light});
    return stage;
}

Renderer make_renderer(const Options& options, const Stage& stage,
                       std::shared_ptr<gl::Context> context) {
    std::shared_ptr<Technique> technique = make_technique(options.technique);
    for (const auto& [name, value] : options.params) technique->param(name).assign(value);
    Renderer renderer{stage.scene, stage.camera(), std::move(technique), std::move(context)};
    for (const auto& [name, value] : options.settings)
        renderer.settings().param(name).assign(value);
    return renderer;
}

Viewer::Viewer(const Options& options, Stage stage)
    : options_{options},
      stage_{std::move(stage)},
      window_{gl::Window::create(1024, 768, "opacity")},
      renderer_{make_renderer(options_, stage_, window_)} {
    window_->on_drag = [this](const gl::Drag& event) { drag(event); };
    window_->on_scroll = [this](double, double dy) {
        distance_factor_ = std::clamp(distance_factor_ * std::pow(0.9, dy), 0.05, 20.0);
    };
    window_->on_key = [this](const gl::Key& event) { key(event); };
    renderer_.set_background({0.75f, 0.78f, 0.82f, 1.f});
}

void Viewer::run() {
    for (int frame = 0;
         !window_->should_close() && (options_.frames == 0 || frame < options_.frames); ++frame) {
        window_->poll();
        const auto start = std::chrono::steady_clock::now();
        const gl::Window::Size size = window_->framebuffer_size();
        if (size.width > 0 && size.height > 0)
            renderer_.set_size(size.width, size.height);  // 0: minimised
        renderer_.set_camera(stage_.camera(distance_factor_));
        image_ = renderer_.render();
        {
            const gl::Context::Use use{*window_};
            window_->present(image_.rgba.data(), image_.width, image_.height);
            window_->swap();
        }
        const std::chrono::duration<double, std::milli> elapsed =
            std::chrono::steady_clock::now() - start;
        show_title(elapsed.count());
    }
    if (!options_.output.empty()) save(options_.output);
}

void Viewer::drag(const gl::Drag& drag) {
    if (drag.button == 1 || drag.shift)
        stage_.light->set_direction(
            dragged(stage_.light->direction(), stage_.up, drag.dx, drag.dy));
    else
        stage_.view_direction = dragged(stage_.view_direction, stage_.up, drag.dx, drag.dy);
}

void Viewer::key(const gl::Key& key) {
    constexpr int escape = 256;
    if (!key.pressed) return;
    if (key.code == 'T') next_technique();
    if (key.code == '=' || key.code == '+') change_layers(+1);
    if (key.code == '-') change_layers(-1);
    if (key.code == 'R') std::fputs(to_string(renderer_.report()).c_str(), stdout);
    if (key.code == 'S') save("opacity.png");
    if (key.code == escape) window_->close();
}

void Viewer::next_technique() {
    const std::vector<std::string> names = technique_names();
    const auto current = std::find(names.begin(), names.end(), renderer_.technique().name());
    renderer_.set_technique(
        make_technique(current + 1 == names.end() ? names.front() : *(current + 1)));
}

// Doubles or halves; a technique without layers, or at the end of its range, stays as it is.
void Viewer::change_layers(int change) {
    for (ParamBase* param : renderer_.technique().params()) {
        if (param->name() != "layers") continue;
        const std::int64_t layers = std::get<std::int64_t>(param->value());
        try {
            param->assign(change > 0 ? 2 * layers : std::max<std::int64_t>(1, layers / 2));
        } catch (const ParameterError& error) {
            std::fprintf(stderr, "%s\n", error.problem().c_str());
        }
    }
}

void Viewer::show_title(double frame_ms) {
    std::string title = renderer_.technique().name();
    for (ParamBase* param : renderer_.technique().params())
        if (param->name() == "layers") title += ", " + to_string(param->value()) + " layers";
    char time[32];
    std::snprintf(time, sizeof time, ", %.0f ms", frame_ms);
    window_->set_title(title + time);
}

void Viewer::save(const std::string& path) const {
    save_png(path, image_);
    std::printf("%s: %dx%d\n", path.c_str(), image_.width, image_.height);
}

}  // namespace opacity::demo
