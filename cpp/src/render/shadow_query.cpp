#include "render/shadow_query.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "core/parallel.hpp"
#include "map/lookup.hpp"
#include "render/shadow_sweep.hpp"

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

MapLookUp look_up_of(const ShadowQuery::Asked& asked, const TexelMap& map,
                     const OpaqueDepth& opaque, const DepthSlab& slab = {}) {
    return {asked.space, map, opaque, filter_of(asked.technique), asked.technique.bias.get(), slab};
}

OpaqueDepth opaque_depth(PassContext& context, const ShadowLookUp& look_up) {
    return {context.memory<float>(*look_up.opaque_depth),
            context.memory<float>(*look_up.opaque_moved)};
}

template <class Body>
void in_parts(std::size_t count, Body body) {
    parallel_for((count + receivers_at_once - 1) / receivers_at_once, [&](std::size_t part) {
        const std::size_t begin = part * receivers_at_once;
        for (std::size_t i = begin; i < std::min(count, begin + receivers_at_once); ++i) body(i);
    });
}

// Draws planes, each once, with what changes them. GLSL and C++ share it.
class PlaneDraws {
   public:
    PlaneDraws(const Sweep& sweep, const LightSpace& space) : sweep_{sweep}, space_{space} {}

    // Those that are missing before a look-up in front of this one.
    template <class Draw>
    void draw_to(int plane, Draw draw) {
        const std::vector<float>& planes = sweep_.planes->get();
        const int last = std::min(plane + sweep_.planes_ahead - 1, int(planes.size()) - 1);
        while (drawn_ < last) {
            const ShapeFilter is_near = near_plane(planes, ++drawn_, space_);
            draw(drawn_, [&](const Shape& shape) {
                const bool wanted = is_near(shape);
                ++(wanted ? drawn_shapes_ : stored_shapes_);
                return wanted;
            });
        }
    }
    std::string note() const {
        std::string text = std::to_string(drawn_) + " slices in turn";
        if (stored_shapes_ == 0) return text;
        const int all = drawn_shapes_ + stored_shapes_;
        return text + ", " + std::to_string(drawn_shapes_) + " of " + std::to_string(all) +
               " draws";
    }

   private:
    const Sweep& sweep_;
    const LightSpace& space_;
    int drawn_ = 0, drawn_shapes_ = 0, stored_shapes_ = 0;
};

// Rounding shall not make more light of all parts than there is.
void add_part(float& sum, float part) {
    sum = std::min(sum + part, 1.f);
}

struct NoCasters : TexelMap {
    float optical_depth(std::size_t, float, const OwnDeposit&) const override { return 0.f; }
};

}  // namespace

const Resource& ShadowQuery::add(FrameGraph& graph, const ShadowLookUp& look_up,
                                 const Technique& technique, const LightSpace& space,
                                 const View& light) {
    const Buffers buffers{graph.buffer("query"), graph.buffer("transmittance")};
    const std::optional<Sweep>& sweep = look_up.sweep;
    Pass pass{.name = "transmittance",
              .reads = sweep ? sweep->reads : look_up.reads,
              .stores = {&buffers.query, &buffers.transmittance}};
    if (sweep) {
        pass.shader = sweep->shader;
        pass.draws = sweep->draws;
        pass.view = &light;
        pass.writes = {sweep->map};
        pass.stores.push_back(sweep->map);
        pass.state.blend = Blend::add;
    } else {
        pass.shader.defines = look_up.defines;
    }
    pass.shader.compute = "transmittance.comp.glsl";
    pass.shader.technique = look_up.shader;
    pass.reads.push_back(&asked_);
    if (look_up.opaque_moved) {
        pass.reads.push_back(look_up.opaque_moved);
        pass.shader.defines.emplace_back("BARE_POINTS", "1");
    }
    const Asked asked{look_up, technique, space, buffers};
    pass.execute = [this, asked](PassContext& context) { ask_all(context, asked); };
    pass.on_cpu = [this, asked](PassContext& context) {
        asked.look_up.sweep ? sweep_on_cpu(context, asked) : look_up_all(context, asked);
    };
    graph.add(std::move(pass));
    return buffers.transmittance;
}

void ShadowQuery::ask(const LightSpace& space, const Query& query, bool own_correction) {
    const bool is_other = update_receivers(space, query, own_correction);
    const float width = float(query.strand_width);
    if (is_other || width != receiver_width_) asked_.touch();
    receiver_width_ = width;
    transmittance_.resize(receivers_.size(), 1.f);
    if (!is_other && query.own) return;
    // Of points the map may have grown about the same places.
    outside_ = std::size_t(std::ranges::count_if(
        receivers_, [&](const Receiver& receiver) { return is_outside_map(receiver, space); }));
}

// Whether any is another than before.
bool ShadowQuery::update_receivers(const LightSpace& space, const Query& query,
                                   bool own_correction) {
    if (!query.own) {
        cause_.reset();
        return replace_receivers(receivers_, space, query.world_points);
    }
    const Revision opacity = [&] {
        const auto lock = query.own->lock();
        return query.own->revisions().opacity;
    }();
    Cause now{query.placed, opacity, query.is_in_maps, own_correction, space};
    if (now == cause_) return false;
    receivers_ = receivers_in(space, query, own_correction);
    cause_ = std::move(now);
    return true;
}

void ShadowQuery::note_outside(PassContext& context) const {
    if (outside_ > 0)
        context.note(std::to_string(outside_) + " of " + std::to_string(receivers_.size()) +
                     " receivers outside the map");
}

void ShadowQuery::ask_all(PassContext& context, const Asked& asked) {
    note_outside(context);
    transmittance_.clear();
    for (std::size_t first = 0; first < receivers_.size(); first += most_receivers) {
        const std::span<const Receiver> part = std::span{receivers_}.subspan(
            first, std::min(most_receivers, receivers_.size() - first));
        const std::vector<float> answers =
            asked.look_up.sweep ? sweep(context, asked, part) : ask(context, asked, part);
        transmittance_.insert(transmittance_.end(), answers.begin(), answers.end());
    }
}

// All of them, or those of a part, which are in the buffers already.
void ShadowQuery::dispatch(PassContext& context, std::size_t first, std::size_t count,
                           Uniforms more) const {
    more.insert(more.end(), {{"u_receiver_first", int(first)},
                             {"u_receiver_count", int(count)},
                             {"u_receiver_width", receiver_width_}});
    context.dispatch(int(count), more);
}

std::vector<float> ShadowQuery::ask(PassContext& context, const Asked& asked,
                                    std::span<const Receiver> receivers) const {
    context.resize(asked.buffers.query, receivers.size_bytes());
    context.resize(asked.buffers.transmittance, receivers.size() * sizeof(float));
    context.write(asked.buffers.query, std::as_bytes(receivers));
    dispatch(context, 0, receivers.size());
    return context.read<float>(asked.buffers.transmittance);
}

std::vector<float> ShadowQuery::sweep(PassContext& context, const Asked& asked,
                                      std::span<const Receiver> receivers) const {
    const Sweep& sweep = *asked.look_up.sweep;
    const std::vector<float>& planes = sweep.planes->get();
    const SlabLists lists =
        sorted_into_slabs(receivers, receiver_width_, look_up_of(asked, NoCasters{}, {}), planes);
    std::vector<Receiver> sorted;
    for (const std::uint32_t i : lists.receivers) sorted.push_back(receivers[i]);
    context.resize(asked.buffers.query, sorted.size() * sizeof(Receiver));
    context.resize(asked.buffers.transmittance, sorted.size() * sizeof(float));
    context.write(asked.buffers.query, std::as_bytes(std::span{sorted}));
    context.zero(*sweep.map);
    PlaneDraws draws{sweep, asked.space};
    for (std::size_t slab = 0; slab < lists.slabs(); ++slab) {
        draws.draw_to(int(slab) + 1, [&](int plane, const ShapeFilter& wanted) {
            context.draw({{"u_plane", plane}}, wanted);
        });
        const DepthSlab here = slab_of(planes, slab);
        dispatch(context, lists.firsts[slab], lists.of(slab).size(),
                 {{"u_slab", std::vector<float>{here.begin, here.end}},
                  {"u_is_first_slab", here.is_first},
                  {"u_is_last_slab", here.is_last}});
    }
    context.note(draws.note());
    const auto answers = context.read<float>(asked.buffers.transmittance);
    std::vector<float> sums(receivers.size(), 0.f);
    for (std::size_t i = 0; i < answers.size(); ++i) add_part(sums[lists.receivers[i]], answers[i]);
    return sums;
}

void ShadowQuery::look_up_all(PassContext& context, const Asked& asked) {
    note_outside(context);
    transmittance_.assign(receivers_.size(), 1.f);
    if (!asked.look_up.on_cpu || outside_ == receivers_.size()) return;
    const std::unique_ptr<TexelMap> map = asked.look_up.on_cpu(context);
    const MapLookUp answers = look_up_of(asked, *map, opaque_depth(context, asked.look_up));
    in_parts(receivers_.size(), [&](std::size_t i) {
        transmittance_[i] = answers.transmittance(receivers_[i], receiver_width_);
    });
}

void ShadowQuery::sweep_on_cpu(PassContext& context, const Asked& asked) {
    const Sweep& sweep = *asked.look_up.sweep;
    const std::vector<float>& planes = sweep.planes->get();
    const std::unique_ptr<TexelMap> map = sweep.on_cpu(context);
    const OpaqueDepth opaque = opaque_depth(context, asked.look_up);
    const SlabLists lists =
        sorted_into_slabs(receivers_, receiver_width_, look_up_of(asked, *map, opaque), planes);
    transmittance_.assign(receivers_.size(), 0.f);
    PlaneDraws draws{sweep, asked.space};
    for (std::size_t slab = 0; slab < lists.slabs(); ++slab) {
        draws.draw_to(int(slab) + 1, [&](int plane, const ShapeFilter& wanted) {
            sweep.draw_on_cpu(context, plane, wanted);
        });
        const MapLookUp answers = look_up_of(asked, *map, opaque, slab_of(planes, slab));
        const std::span<const std::uint32_t> here = lists.of(slab);
        in_parts(here.size(), [&](std::size_t i) {
            add_part(transmittance_[here[i]],
                     answers.transmittance(receivers_[here[i]], receiver_width_));
        });
    }
    context.note(draws.note());
}

}  // namespace opacity::render
