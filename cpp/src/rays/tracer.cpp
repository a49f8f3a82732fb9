#include "rays/tracer.hpp"

#include <algorithm>

#include "rays/footprint.hpp"

namespace opacity::rays {
namespace {

double at(const std::vector<double>& values, std::size_t i) {
    return values[values.size() > 1 ? i : 0];
}

}  // namespace

Tracer::Tracer(const Casters& casters, const Backend& backend, const Light& light,
               const Asked& asked)
    : casters_{casters},
      backend_{backend},
      asked_{asked},
      box_{casters.bounds.padded(2.0 * box_margin)} {
    for (const double3& point : light_points(light))
        sources_.push_back(casters.frame.from_world(point));
}

std::size_t Tracer::rays_a_point() const {
    return std::max<std::size_t>(1, sources_.size()) * std::size_t(asked_.samples);
}

Ray Tracer::ray_from(const double3& origin, std::size_t source) const {
    return sources_.empty() ? parallel_ray(origin) : ray_to(sources_[source], origin);
}

double Tracer::transmittance(std::size_t point, Hits& hits) const {
    const double scale = casters_.frame.scale;
    const Receivers& receivers = asked_.receivers;
    Place place{casters_.frame.from_world(receivers.world_points[point]),
                at(asked_.bias, point) * scale, at(asked_.footprint, point) * scale, Casters::none};
    if (receivers.at_particles && casters_.first_own_sphere != Casters::none)
        place.own =
            casters_.number_of_sphere(casters_.first_own_sphere + std::uint32_t(asked_.own[point]));
    const std::size_t sources = std::max<std::size_t>(1, sources_.size());
    double sum = 0.0;
    for (std::size_t source = 0; source < sources; ++source)
        sum += mean_over_footprint(point, place, source, hits);
    return sum / double(sources);
}

double Tracer::mean_over_footprint(std::size_t point, const Place& place, std::size_t source,
                                   Hits& hits) const {
    const Ray middle = ray_from(place.center, source);
    const double3 direction = casters_.frame.turned_back(middle.toward);
    const double own_part = asked_.receivers.own_half_chord(direction) * casters_.frame.scale;
    const double bias = std::max(place.bias, own_part);
    if (!(place.side > 0.0)) return transmittance(middle, {bias, middle.length}, place.own, hits);
    double sum = 0.0;
    for (int i = 0; i < asked_.samples; ++i) {
        const auto offset = footprint_offset(point, i, asked_.samples);
        const double3 origin = middle.at(0.0, {place.side * offset[0], place.side * offset[1]});
        const Ray ray = ray_from(origin, source);
        sum += transmittance(ray, {bias, ray.length}, place.own, hits);
    }
    return sum / asked_.samples;
}

double Tracer::transmittance(const Ray& ray, const Span& span, std::uint32_t own,
                             Hits& hits) const {
    const Reach reach = reach_within(ray, span, box_);
    if (!(reach.length >= 0.0)) return 1.0;
    hits.start(ray, span, own);
    backend_.search(hits, reach);
    return hits.transmittance();
}

}  // namespace opacity::rays
