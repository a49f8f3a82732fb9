#include "render/strand_shadows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "core/vector.hpp"
#include "opacity/core/error.hpp"
#include "scene/texel_side.hpp"

namespace opacity::render {
namespace {

// Between two places, in segments of root mean square length. Of 1 to 8 the largest at which total
// errors on hair are no larger than per sample (docs/accuracy.md).
constexpr double texels_a_step = 3.0;
constexpr int most_steps = 64;
// Up to so many places a sample they are worth it where all moves, or nearly so, and from then on
// for nothing; strands that are blended show all of their samples (docs/performance.md).
constexpr double most_places_a_solid_sample = 2.0, most_places_a_blended_sample = 3.0;
constexpr std::size_t most_places = std::size_t{1} << 25;  // storage buffers may end at 128 MiB

bool has_places(const Shape& shape) {
    const auto lock = shape.lock();
    return dynamic_cast<const Strands*>(&shape) && shape.receives();
}

double rms_length(const Strands& strands) {
    const Positions& points = strands.points();
    double sum = 0.0;
    for (const std::uint32_t i : strands.segments()) {
        const double3 a = points[i], b = points[i + 1];
        for (std::size_t axis = 0; axis < 3; ++axis)
            sum += (b[axis] - a[axis]) * (b[axis] - a[axis]);
    }
    return strands.segments().empty() ? 0.0 : std::sqrt(sum / double(strands.segments().size()));
}

// Of a picture, in a unit of area at a distance from the eye.
double samples_an_area(const PictureInputs& inputs, double distance) {
    const double half_height =
        distance * std::tan(inputs.camera.fov_deg() * std::numbers::pi / 360.0);
    const double samples = inputs.settings.antialiasing.get() * inputs.settings.height.get();
    const double per_length = samples / std::max(2.0 * half_height, 1e-30);
    return per_length * per_length;
}

// Of a list that holds the strands alone, from those of the whole.
std::vector<int> of_drawn_strands(const DrawList& shapes, const std::vector<int>& of_shapes) {
    std::vector<int> found;
    for (std::size_t i = 0; i < shapes.shapes().size(); ++i)
        if (has_places(*shapes.shapes()[i]))
            found.insert(found.end(), {of_shapes[2 * i], of_shapes[2 * i + 1]});
    return found;
}

void write_places(PassContext& context, Buffer& buffer, const std::vector<int>& places) {
    context.resize(buffer, places.size() * sizeof(int));
    context.write(buffer, std::as_bytes(std::span{places}));
}

}  // namespace

void StrandShadows::begin_frame() {
    places_.clear();
    known_lengths_ = std::exchange(lengths_, {});
}

double StrandShadows::segment_length(const Strands& strands) {
    const Revision geometry = strands.revisions().geometry;
    const auto known = known_lengths_.find(geometry);
    const auto [found, is_new] = lengths_.try_emplace(geometry, 0.0);
    if (is_new) found->second = known != known_lengths_.end() ? known->second : rms_length(strands);
    return found->second * strands.scale();
}

// What else is in the list moves none of its passes.
DrawList& StrandShadows::strands_of(const DrawList& shapes) {
    std::vector<ShapePtr> strands;
    for (const ShapePtr& shape : shapes.shapes())
        if (has_places(*shape)) strands.push_back(shape);
    DrawList& list = strands_.try_emplace(&shapes, shapes.name() + " along strands").first->second;
    list.update(std::move(strands));
    return list;
}

StrandShadows::Places StrandShadows::places_on(const DrawList& shapes, const LightSpace& space,
                                               const PictureInputs& inputs) {
    Places places;
    for (const ShapePtr& shape : shapes.shapes()) {
        places.of_shapes.insert(places.of_shapes.end(),
                                {int(std::min(places.count, most_places)), 0});
        if (!has_places(*shape)) continue;
        const auto lock = shape->lock();
        const auto& strands = dynamic_cast<const Strands&>(*shape);
        const double3 middle = strands.bounds().center();
        const double length = segment_length(strands), count = double(strands.segments().size());
        const double steps = std::ceil(length / (texels_a_step * texel_side(space, middle)));
        places.of_shapes.back() = int(std::clamp(steps, 1.0, double(most_steps)));
        places.count += strands.segments().size() * std::size_t(places.of_shapes.back() + 1);
        places.samples += count * length * strands.strand_width() *
                          samples_an_area(inputs, distance(middle, inputs.camera.eye()));
    }
    return places;
}

bool StrandShadows::is_wanted(const RenderSettings& settings, const Places& places,
                              double most_places_a_sample) {
    if (settings.strand_look_up.is("per_sample") || places.count == 0) return false;
    if (settings.strand_look_up.is("auto"))
        return places.count <= most_places &&
               double(places.count) <= most_places_a_sample * places.samples;
    if (places.count > most_places)
        throw ParameterError("strand_look_up = along_strands needs " +
                                 std::to_string(places.count) + " places, and a buffer holds " +
                                 std::to_string(most_places),
                             "set it to auto or per_sample, or lower map_size");
    return true;
}

void StrandShadows::add(FrameGraph& graph, const PictureInputs& inputs, const std::string& name,
                        std::size_t index, DrawList& shapes) {
    const LightMaps& light = *inputs.lights[index];
    // Nothing to look up, or in maps that move with the camera.
    if (!light.is_shadowed() || !light.space().splits.empty()) return;
    const Places found = places_on(shapes, light.space(), inputs);
    const bool is_blended = &shapes == &inputs.lists.blended;
    if (!is_wanted(inputs.settings, found,
                   is_blended ? most_places_a_blended_sample : most_places_a_solid_sample))
        return;
    const FrameGraph::Scope scope{graph, name};
    const Buffers buffers = add_pass(graph, light, found, shapes);
    places_.emplace(std::pair{index, &shapes}, buffers);
}

StrandShadows::Buffers StrandShadows::add_pass(FrameGraph& graph, const LightMaps& light,
                                               const Places& found, const DrawList& shapes) {
    const ShadowLookUp& look_up = light.look_up();
    DrawList& strands = strands_of(shapes);
    auto &of_strands = graph.value("of_strands", std::vector<int>{}),
         &of_shapes = graph.value("of_shapes", std::vector<int>{});
    of_strands.set(of_drawn_strands(shapes, found.of_shapes));
    of_shapes.set(found.of_shapes);
    Buffer &own_places = graph.buffer("places"), &places = graph.buffer("strand_places"),
           &transmittance = graph.buffer("strand_transmittance");
    Pass pass{.name = "strand_shadows",
              .shader = {.compute = "strand_shadows.comp.glsl",
                         .technique = look_up.shader,
                         .defines = look_up.defines},
              .draws = &strands,
              .view = &light.view(),
              .draws_unseen = true,
              .reads = look_up.reads,
              .stores = {&own_places, &places, &transmittance},
              .execute = [&own_places, &places, &transmittance, &of_strands, &of_shapes,
                          count = found.count](PassContext& context) {
                  write_places(context, own_places, of_strands.get());
                  write_places(context, places, of_shapes.get());
                  context.resize(transmittance, count * sizeof(float));
                  context.dispatch_shapes();
                  context.note(std::to_string(count) + " places");
              }};
    pass.reads.insert(pass.reads.end(), {&of_strands, &of_shapes});
    if (look_up.own_correction) {
        pass.shader.defines.emplace_back("OWN_CORRECTION", "1");
        pass.reads.push_back(&strands.opacity);
    }
    graph.add(std::move(pass));
    return {places, transmittance};
}

void StrandShadows::add_look_up(Pass& pass, std::size_t light, const DrawList& shapes) const {
    const auto found = places_.find({light, &shapes});
    if (found == places_.end()) return;
    pass.shader.defines.emplace_back("ALONG_STRANDS", "1");
    pass.reads.insert(pass.reads.end(), {&found->second.places, &found->second.transmittance});
}

}  // namespace opacity::render
