#include "opacity/trace.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/parallel.hpp"
#include "opacity/core/error.hpp"
#include "rays/backend.hpp"
#include "rays/footprint.hpp"
#include "scene/bias.hpp"
#include "scene/check.hpp"
#include "scene/light_fit.hpp"
#include "scene/receivers.hpp"

namespace opacity {
namespace {

using rays::Casters;
using rays::Ray;

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
                         "count from 0, or add a DirectionalLight to the scene");
}

void check_bias(const std::vector<double>& bias, std::size_t points) {
    if (bias.size() > 1 && bias.size() != points)
        throw ParameterError("bias has " + std::to_string(bias.size()) + " entries for " +
                                 std::to_string(points) + " points",
                             "pass one for all, one a point, or none for the automatic one");
    for (std::size_t i = 0; i < bias.size(); ++i) {
        if (length(bias[i])) continue;
        const std::string index = bias.size() > 1 ? "[" + std::to_string(i) + "]" : "";
        check_value(("bias" + index).c_str(), bias[i], length);
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
    check_value("footprint", settings.footprint, length);
    check_value("samples", double(settings.samples), sample_count);
    check_value("threads", double(settings.threads), thread_count);
    check_bias(settings.bias, points.size());
    chosen_backend(settings.backend);
}

// ---- rays ----

// What lies beyond the casters' box need not be searched; where it is missed, nothing.
rays::Reach reach_within(const Ray& ray, double from, const Box& box) {
    double to = Box::infinity;
    for (std::size_t i = 0; i < 3; ++i) {
        const double low = box.min[i] - ray.origin[i], high = box.max[i] - ray.origin[i];
        if (ray.toward[i] == 0.0) {
            if (low > 0.0 || high < 0.0) return {{}, -1.0};
            continue;
        }
        const double a = low / ray.toward[i], b = high / ray.toward[i];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    rays::Reach reach{{}, to - from};
    for (std::size_t i = 0; i < 3; ++i)  // what a far origin rounds away is put right
        reach.start[i] = std::clamp(ray.origin[i] + from * ray.toward[i], box.min[i], box.max[i]);
    return reach;
}

// Everything that the threads share; in the frame of the casters, whose z axis light travels along.
class Tracer {
   public:
    Tracer(const Casters& casters, const rays::Backend& backend, const Positions& points,
           const TraceSettings& settings, std::vector<double> bias)
        : casters_{casters},
          backend_{backend},
          points_{points},
          samples_{settings.footprint > 0.0 ? settings.samples : 1},
          side_{settings.footprint * casters.frame.scale},
          bias_{std::move(bias)},
          box_{casters.bounds.padded(2.0 * rays::box_margin)} {}

    int samples() const { return samples_; }

    double transmittance(std::size_t point, rays::Hits& hits) const {
        const double3 center = casters_.frame.from_world(points_[point]);
        const double bias = bias_[bias_.size() > 1 ? point : 0] * casters_.frame.scale;
        double sum = 0.0;
        for (int i = 0; i < samples_; ++i) {
            Ray ray{center, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
            if (side_ > 0.0) {
                const auto offset = rays::footprint_offset(point, i, samples_);
                ray.origin[0] += side_ * offset[0];
                ray.origin[1] += side_ * offset[1];
            }
            sum += transmittance(ray, bias, hits);
        }
        return sum / samples_;
    }

   private:
    double transmittance(const Ray& ray, double bias, rays::Hits& hits) const {
        const rays::Reach reach = reach_within(ray, bias, box_);
        if (!(reach.length >= 0.0)) return 1.0;
        hits.start(ray, bias);
        backend_.search(hits, reach);
        return hits.transmittance();
    }

    const Casters& casters_;
    const rays::Backend& backend_;
    const Positions& points_;
    const int samples_;
    const double side_;
    const std::vector<double> bias_;  // world units
    const Box box_;
};

using Watch = std::function<void(double)>;

std::unique_ptr<rays::Backend> build(const Casters& casters, const std::string& name,
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

std::vector<float> trace(const Scene& scene, const Positions& points, const TraceSettings& settings,
                         double receiver_width) {
    const Watch watch = settings.progress ? settings.progress : [](double) {};
    std::vector<float> result(points.size(), 1.f);
    check(scene, points, settings);
    const auto finish = [&] { return watch(1.0), std::move(result); };
    if (scene.lights().empty() || points.size() == 0) return finish();
    const double3& direction =
        require_directional(*scene.lights()[std::size_t(settings.light)]).direction();
    const Casters casters = rays::casters_of(scene, light_rotation(direction));
    if (casters.primitive_count() == 0) return finish();

    std::vector<double> bias = settings.bias;
    if (bias.empty()) bias = {std::max(receiver_width, least_bias(scene))};
    const auto backend = build(casters, chosen_backend(settings.backend), watch);
    const Tracer tracer{casters, *backend, points, settings, std::move(bias)};
    const std::size_t points_at_once = std::max<std::size_t>(1, rays_at_once / tracer.samples());
    const auto work = [&](std::size_t part, std::stop_token stop) {
        rays::Hits hits{casters};
        const std::size_t end = std::min(points.size(), (part + 1) * points_at_once);
        for (std::size_t i = part * points_at_once; i < end && !stop.stop_requested(); ++i)
            result[i] = float(tracer.transmittance(i, hits));
    };
    in_parallel((points.size() + points_at_once - 1) / points_at_once, settings.threads, work,
                watch);
    return finish();
}

}  // namespace

std::vector<std::string> trace_backends() {
    if (rays::has_embree()) return {"embree", "builtin"};
    return {"builtin"};
}

std::vector<float> trace_transmittance(const Scene& scene, const Positions& world_points,
                                       const TraceSettings& settings) {
    return trace(scene, world_points, settings, mean_strand_width(scene.shapes()));
}

std::vector<float> trace_transmittance(const Scene& scene, const Shape& shape,
                                       const TraceSettings& settings) {
    const Receivers receivers = receivers_on(shape);
    return trace(scene, receivers.world_points, settings, receivers.strand_width);
}

}  // namespace opacity
