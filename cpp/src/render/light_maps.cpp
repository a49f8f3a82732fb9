#include "render/light_maps.hpp"

#include <algorithm>
#include <optional>

#include "map/fragments.hpp"
#include "render/light_view.hpp"
#include "scene/map_window.hpp"

namespace opacity::render {
namespace {

std::string scoped(const std::string& scope, const std::string& name) {
    return scope.empty() ? name : scope + "/" + name;
}

const Light& light_or_none(const Light* light) {
    static const DirectionalLight no_light{{0.0, 0.0, -1.0}, {0.f, 0.f, 0.f}, 0.f};
    return light ? *light : no_light;
}

}  // namespace

LightMaps::LightMaps(const std::string& scope)
    : scope_{scope},
      view_{scoped(scope, "light")},
      chosen_size_{"map_size", ""},
      chosen_technique_{"technique", ""},
      chosen_detail_{"map_detail", ""},
      query_{scoped(scope, "query_points")} {}

void LightMaps::fit(const Scene& scene, const Light* light, const LightDefaults& defaults,
                    const CameraView& camera, const Box& query) {
    is_lit_ = light != nullptr;
    culls_ = defaults.culling.get();
    technique_ = light && light->technique() ? light->technique() : defaults.technique;
    own_map_size_px_ = light ? light->map_size() : 0;
    if (!defaults.steady.get()) fit_ = {}, split_fit_ = {};
    space_ = fit_.fit(
        scene, light_or_none(light),
        [&](double side) { return map_size_px(scene, defaults.map_size, side); }, query);
    const Technique::Delegate delegate = technique_->delegate(scene, space_);
    if (delegate.technique) technique_ = delegate.technique;
    chosen_technique_.set(delegate.why);
    space_.splits = split_fit_.fit(space_, scene, camera, technique_->view_splits());
    choose_detail(scene, defaults.map_detail);
    update_light_view(view_, space_);
}

// A line one texel wide, as in the papers, stands for no more strands when it is wider.
void LightMaps::choose_detail(const Scene& scene, const AutoParam<double>& map_detail) {
    MapDetail chosen;
    if (!technique_->deposit_rule.is("paper"))
        chosen = map_detail_rule_.choose(scene, space_, map_detail);
    else if (map_detail.is_auto() || map_detail.get() < 1.0)
        chosen.why = "all strands: deposit_rule is paper";
    space_.strand_detail = chosen.strand_detail;
    chosen_detail_.set(chosen.why);
}

int LightMaps::map_size_px(const Scene& scene, const AutoParam<int>& map_size, double side) {
    if (own_map_size_px_ > 0 || !map_size.is_auto()) {
        chosen_size_.set("");
        return own_map_size_px_ > 0 ? own_map_size_px_ : map_size.get();
    }
    const MapSize chosen = map_size_rule_.choose(scene, side, technique_->filter_width.get());
    chosen_size_.set(std::to_string(chosen.size_px) + " texels: " + chosen.why);
    return chosen.size_px;
}

void LightMaps::add_passes(FrameGraph& graph, SceneLists& lists) {
    std::optional<FrameGraph::Scope> scope;
    if (!scope_.empty()) scope.emplace(graph, scope_);
    casters_.collect();
    cull(lists);
    look_up_ = add_shadows(graph, lists);
    is_shadowed_ = !look_up_.reads.empty();
    for (const Value<std::string>* chosen : {&chosen_size_, &chosen_technique_, &chosen_detail_})
        if (!chosen->get().empty()) look_up_.reads.push_back(&add_choice(graph, lists, *chosen));
    look_up_.reads.push_back(&view_);  // lighting places every vertex in the light's map
    transmittance_ = &query_.add(graph, look_up_, *technique_, space_, view_);
}

void LightMaps::cull(const SceneLists& lists) {
    casters_.set_culling(culls_);
    if (!culls_) return view_.see_all();
    for (const DrawList* list : {&lists.translucent, &lists.opaque})
        view_.cull(list->shapes(), [this](const Box& points, double reach) {
            return is_out_of_map(space_, points, reach);
        });
}

// Says it in the report.
const Source& LightMaps::add_choice(FrameGraph& graph, SceneLists& lists,
                                    const Value<std::string>& chosen) {
    auto& told = graph.value(chosen.name(), std::string{});
    graph.add({.name = chosen.name(),
               .only_with = &lists.translucent,
               .reads = {&chosen},
               .values = {&told},
               .execute = [&chosen, &told](PassContext& context) {
                   context.set(told, chosen.get());
                   context.note(chosen.get());
               }});
    return told;
}

ShadowLookUp LightMaps::add_shadows(FrameGraph& graph, SceneLists& lists) {
    Texture& opaque_depth = add_opaque_depth(graph, lists, false);
    Texture& opaque_moved = add_opaque_depth(graph, lists, true);
    if (!is_lit_) return {};
    const FrameGraph::Scope scope{graph, technique_->name()};
    const bool has_opaque = !lists.opaque.shapes().empty();
    const bool paper_deposit = technique_->deposit_rule.is("paper");
    return {technique_->build(graph, {view_, lists.translucent, opaque_depth, has_opaque,
                                      paper_deposit, space_, casters_}),
            technique_->shader_path(), &opaque_depth, &opaque_moved};
}

Texture& LightMaps::add_opaque_depth(FrameGraph& graph, SceneLists& lists, bool moved_back) {
    const std::string name = moved_back ? "opaque_moved" : "opaque_depth";
    Texture& map = graph.texture(
        name,
        {.format = Format::depth32f, .width = space_.width_px(), .height = space_.height_px()});
    Defines defines = light_defines(space_);
    if (moved_back) defines.emplace_back("MOVED_BACK", "1");
    graph.add({.name = name,
               .shader = {.vertex = "casters.vert.glsl",
                          .fragment = "bounds.frag.glsl",
                          .defines = std::move(defines)},
               .draws = &lists.opaque,
               .view = &view_,
               .writes = {&map},
               .state = {.depth = Depth::less, .clear_depth = 1.f},
               .on_cpu = [this, &map, &lists, moved_back](PassContext& context) {
                   const std::span<float> depth = context.memory<float>(map);
                   const FragmentSource opaque{.casters = casters_,
                                               .shapes = lists.opaque.shapes(),
                                               .space = space_,
                                               .opaque_depth = {},
                                               .optical_depth = false,
                                               .moved_back = moved_back};
                   for_each_fragment(opaque, [&](const Fragment& fragment) {
                       depth[fragment.texel] = std::min(depth[fragment.texel], fragment.depth);
                   });
               }});
    return map;
}

void LightMaps::ask(const Query& query) {
    query_.ask(space_, query, look_up_.own_correction);
}

}  // namespace opacity::render
