#include "opacity/trace.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "core/parallel.hpp"
#include "opacity/core/error.hpp"
#include "rays/tracer.hpp"
#include "scene/bias.hpp"
#include "scene/channel_scenes.hpp"
#include "scene/check.hpp"
#include "scene/receivers.hpp"

namespace opacity {
namespace {

constexpr Allowed length{0.0, max_coordinate, "in 0..1e18, in world units"};
constexpr Allowed sample_count{1, 65536, "in 1..65536"};
constexpr Allowed thread_count{0, 1024, "in 0..1024"};
// Of rays between two looks at the clock.
constexpr std::size_t rays_at_once = 4096;

// ---- what is asked ----

void check_light(const Scene& scene, int light) {
    const int count = int(scene.lights().size());
    if (light >= 0 && light < std::max(count, 1)) return;
    throw ParameterError("light = " + std::to_string(light) + " of " + std::to_string(count),
                         "count from 0, or add a light to the scene");
}

// One for all, or one a point.
void check_lengths(const std::string& name, const std::vector<double>& values, std::size_t points) {
    if (values.size() > 1 && values.size() != points)
        throw ParameterError(name + " has " + std::to_string(values.size()) + " entries for " +
                                 std::to_string(points) + " points",
                             "pass one for all, or one a point");
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (length(values[i])) continue;
        const std::string index = values.size() > 1 ? "[" + std::to_string(i) + "]" : "";
        check_value((name + index).c_str(), values[i], length);
    }
}

// The backend that was asked for, or the first there is.
std::string chosen_backend(const std::string& name) {
    const std::vector<std::string> built_in = trace_backends();
    if (name == "auto") return built_in.front();
    if (std::find(built_in.begin(), built_in.end(), name) != built_in.end()) return name;
    if (name == "embree")
        throw ParameterError("backend = \"embree\" was not built in",
                             "install Embree (Debian: libembree-dev) and build again, or choose "
                             "backend = \"builtin\", which gives the same result");
    throw ParameterError("backend = \"" + name + "\" is not known",
                         "choose \"auto\", \"embree\" or \"builtin\"");
}

void check(const Scene& scene, const Positions& points, const TraceSettings& settings) {
    check_receivers(points);
    check_light(scene, settings.light);
    check_value("samples", double(settings.samples), sample_count);
    check_value("threads", double(settings.threads), thread_count);
    check_lengths("footprint", settings.footprint, points.size());
    check_lengths("bias", settings.bias, points.size());
    chosen_backend(settings.backend);
}

// Those of a shape's points that are asked about.
Receivers chosen(Receivers all, const std::vector<std::size_t>& indices) {
    const std::size_t count = all.world_points.size();
    std::vector<double> xyz;
    xyz.reserve(3 * indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= count)
            throw ParameterError("indices[" + std::to_string(i) +
                                     "] = " + std::to_string(indices[i]) + " of " +
                                     std::to_string(count) + " points",
                                 "count from 0");
        const double3 p = all.world_points[indices[i]];
        xyz.insert(xyz.end(), p.begin(), p.end());
    }
    all.world_points = Positions{std::move(xyz)};
    return all;
}

std::vector<std::size_t> every_index(std::size_t count) {
    std::vector<std::size_t> indices(count);
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
}

// ---- rays ----

using Watch = std::function<void(double)>;

std::unique_ptr<rays::Backend> build(const rays::Casters& casters, const std::string& name,
                                     const Watch& watch) {
    std::unique_ptr<rays::Backend> backend;
    in_parallel(
        1, 1,
        [&](std::size_t, std::stop_token token) {
            const rays::Stop stop = [&] { return token.stop_requested(); };
            backend = (name == "embree" ? rays::build_embree : rays::build_builtin)(casters, stop);
        },
        [&](double) { watch(0.0); });
    return backend;
}

// `own`: whose points the receivers are, or null.
std::vector<float> trace(const Scene& scene, rays::Asked asked, const Shape* own,
                         const TraceSettings& settings) {
    const Watch watch = settings.progress ? settings.progress : [](double) {};
    const std::size_t count = asked.receivers.world_points.size();
    std::vector<float> result(count, 1.f);
    check(scene, asked.receivers.world_points, settings);
    const auto finish = [&] { return watch(1.0), std::move(result); };
    if (scene.lights().empty() || count == 0) return finish();
    const LightPtr light = scene.lights()[std::size_t(settings.light)];
    const rays::Casters casters = rays::casters_of(scene, *light, own);
    if (casters.primitive_count() == 0) return finish();

    if (settings.bias.empty())
        asked.bias = {std::max(asked.receivers.strand_width, least_bias(scene))};
    const auto backend = build(casters, chosen_backend(settings.backend), watch);
    const rays::Tracer tracer{casters, *backend, *light, asked};
    const std::size_t at_once = std::max<std::size_t>(1, rays_at_once / tracer.rays_a_point());
    const auto work = [&](std::size_t part, std::stop_token stop) {
        rays::Hits hits{casters};
        const std::size_t end = std::min(count, (part + 1) * at_once);
        for (std::size_t i = part * at_once; i < end && !stop.stop_requested(); ++i)
            result[i] = float(tracer.transmittance(i, hits));
    };
    in_parallel((count + at_once - 1) / at_once, settings.threads, work, watch);
    return finish();
}

// The same rays through what each colour of light meets.
std::vector<float> trace_channels(const Scene& scene, const rays::Asked& asked, const Shape* own,
                                  const TraceSettings& settings) {
    const ChannelScenes scenes{scene};
    std::vector<std::vector<float>> channels;
    for (std::size_t c = 0; c < scenes.count(); ++c) {
        TraceSettings here = settings;
        if (settings.progress)
            here.progress = [&, c](double part) {
                settings.progress((double(c) + part) / double(scenes.count()));
            };
        const Shape* stands_for = own ? &scenes.shape(*own, c) : nullptr;
        channels.push_back(trace(scenes[c], asked, stands_for, here));
    }
    return side_by_side(std::move(channels));
}

rays::Asked asked_at(Receivers receivers, std::vector<std::size_t> own,
                     const TraceSettings& settings) {
    const auto& sides = settings.footprint;
    const bool is_point =
        std::all_of(sides.begin(), sides.end(), [](double s) { return s == 0.0; });
    return {std::move(receivers), std::move(own), settings.bias,
            sides.empty() ? std::vector<double>{0.0} : sides, is_point ? 1 : settings.samples};
}

}  // namespace

std::vector<std::string> trace_backends() {
    if (rays::has_embree()) return {"embree", "builtin"};
    return {"builtin"};
}

std::vector<float> trace_transmittance(const Scene& scene, const Positions& world_points,
                                       const TraceSettings& settings) {
    if (settings.indices)
        throw ParameterError("indices count the points of a shape", "pass a shape, or no indices");
    Receivers receivers;
    receivers.world_points = world_points;
    receivers.strand_width = mean_strand_width(scene.shapes());
    return trace_channels(scene, asked_at(std::move(receivers), {}, settings), nullptr, settings);
}

std::vector<float> trace_transmittance(const Scene& scene, const Shape& shape,
                                       const TraceSettings& settings) {
    Receivers receivers = receivers_on(shape);
    std::vector<std::size_t> own =
        settings.indices ? *settings.indices : every_index(receivers.world_points.size());
    if (settings.indices) receivers = chosen(std::move(receivers), own);
    return trace_channels(scene, asked_at(std::move(receivers), std::move(own), settings), &shape,
                          settings);
}

}  // namespace opacity
