#include "render/shadow_query.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "core/parallel.hpp"
#include "map/lookup.hpp"

namespace opacity::render {
namespace {

// Questions are asked in parts: a storage buffer may end at 128 MiB.
constexpr std::size_t most_receivers = std::size_t{1} << 21;

// Of receivers between two looks at what else is to be done, on the CPU.
constexpr std::size_t receivers_at_once = 4096;

// What the look-up's defines and uniforms say, for its form in C++.
Filter filter_of(const Technique& technique) {
    return {filter_kernel(technique.filter.get()), float(technique.filter_radius.get()),
            float(technique.filter_width.get()), technique.filter_domain.is("density")};
}

}  // namespace

const Resource& ShadowQuery::add(FrameGraph& graph, const ShadowLookUp& look_up,
                                 const Technique& technique, const LightSpace& space) {
    const Buffers buffers{graph.buffer("query"), graph.buffer("transmittance")};
    Reads reads = look_up.reads;
    reads.push_back(&asked_);
    Defines defines = look_up.defines;
    if (look_up.opaque_moved) {
        reads.push_back(look_up.opaque_moved);
        defines.emplace_back("BARE_POINTS", "1");
    }
    graph.add(
        {.name = "transmittance",
         .shader = {.compute = "transmittance.comp.glsl",
                    .technique = look_up.shader,
                    .defines = std::move(defines)},
         .reads = std::move(reads),
         .stores = {&buffers.query, &buffers.transmittance},
         .execute = [this, buffers](PassContext& context) { ask_all(context, buffers); },
         .on_cpu = [this, look_up, &technique, &space](
                       PassContext& context) { look_up_all(context, look_up, technique, space); }});
    return buffers.transmittance;
}

void ShadowQuery::set(std::vector<Receiver> receivers, double width) {
    receivers_ = std::move(receivers);
    receiver_width_ = float(width);
    asked_.touch();
}

void ShadowQuery::ask_all(PassContext& context, const Buffers& buffers) {
    transmittance_.clear();
    for (std::size_t first = 0; first < receivers_.size(); first += most_receivers)
        ask(context, buffers, first);
}

void ShadowQuery::ask(PassContext& context, const Buffers& buffers, std::size_t first) {
    const std::span<const Receiver> part =
        std::span{receivers_}.subspan(first, std::min(most_receivers, receivers_.size() - first));
    const int count = int(part.size());
    context.resize(buffers.query, part.size_bytes());
    context.resize(buffers.transmittance, count * sizeof(float));
    context.write(buffers.query, std::as_bytes(part));
    context.dispatch(count, {{"u_receiver_count", count}, {"u_receiver_width", receiver_width_}});
    const std::vector<float> answers = context.read<float>(buffers.transmittance);
    transmittance_.insert(transmittance_.end(), answers.begin(), answers.end());
}

void ShadowQuery::look_up_all(PassContext& context, const ShadowLookUp& look_up,
                              const Technique& technique, const LightSpace& space) {
    transmittance_.assign(receivers_.size(), 1.f);
    if (!look_up.on_cpu) return;
    const std::unique_ptr<TexelMap> map = look_up.on_cpu(context);
    const OpaqueDepth opaque{context.memory<float>(*look_up.opaque_depth),
                             context.memory<float>(*look_up.opaque_moved)};
    const MapLookUp answers{space, *map, opaque, filter_of(technique), technique.bias.get()};
    parallel_for((receivers_.size() + receivers_at_once - 1) / receivers_at_once,
                 [&](std::size_t part) {
                     const std::size_t begin = part * receivers_at_once;
                     const std::size_t end = std::min(receivers_.size(), begin + receivers_at_once);
                     for (std::size_t i = begin; i < end; ++i)
                         transmittance_[i] = answers.transmittance(receivers_[i], receiver_width_);
                 });
}

}  // namespace opacity::render
