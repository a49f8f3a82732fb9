// The maps of one light of a frame: how it is fitted to the scene, the passes that draw them, and
// the look-up of T in them.
#pragma once

#include <memory>
#include <string>

#include "map/light_casters.hpp"
#include "opacity/graph/frame_graph.hpp"
#include "opacity/technique.hpp"
#include "render/scene_lists.hpp"
#include "render/shadow_query.hpp"
#include "scene/light_fit.hpp"
#include "scene/map_detail.hpp"
#include "scene/map_size.hpp"
#include "scene/split_fit.hpp"

namespace opacity::render {

// What every light has unless it has its own.
struct LightDefaults {
    const std::shared_ptr<Technique>& technique;
    const AutoParam<int>& map_size;
    const AutoParam<double>& map_detail;
    const Param<bool>& steady;
    const Param<bool>& culling;
};

class LightMaps {
   public:
    // The names of everything that belongs to the light start with "<scope>/"; of the first light,
    // whose scope is empty, they are plain.
    explicit LightMaps(const std::string& scope);

    // As the light and the scene are now; null: a scene without lights. `query` are world points
    // beyond the scene's receivers that will be asked about. The camera's view counts for
    // techniques that split it, and for no other.
    void fit(const Scene& scene, const Light* light, const LightDefaults& defaults,
             const CameraView& camera, const Box& query);
    // Declares the passes, after which T can be looked up.
    void add_passes(FrameGraph& graph, SceneLists& lists);

    const std::string& scope() const { return scope_; }
    const View& view() const { return view_; }
    const LightSpace& space() const { return space_; }
    const ShadowLookUp& look_up() const { return look_up_; }
    bool is_shadowed() const { return is_shadowed_; }  // else T = 1 without a look
    // The light's T at the receivers of a query, once the frame has run for `goal`.
    const Resource& transmittance_goal() const { return *transmittance_; }
    void ask(const Query& query);
    const std::vector<float>& answers() const { return query_.answers(); }

   private:
    void choose_detail(const Scene& scene, const AutoParam<double>& map_detail);
    int map_size_px(const Scene& scene, const AutoParam<int>& map_size, double side);
    const Source& add_choice(FrameGraph& graph, SceneLists& lists,
                             const Value<std::string>& chosen);
    // `moved_back`: for points that may lie on any of them (lib/surface.glsl).
    Texture& add_opaque_depth(FrameGraph& graph, SceneLists& lists, bool moved_back);
    void cull(const SceneLists& lists);
    ShadowLookUp add_shadows(FrameGraph& graph, SceneLists& lists);

    std::string scope_;
    // The passes declared last refer to its parameters; null: no light, no shadow.
    std::shared_ptr<Technique> technique_;
    bool is_lit_ = false, culls_ = true;
    int own_map_size_px_ = 0;  // 0: the renderer's
    LightFit fit_;
    SplitFit split_fit_;
    LightSpace space_;
    View view_;
    MapSizeRule map_size_rule_;
    MapDetailRule map_detail_rule_;
    // What was chosen before any pass could be declared, and why; empty: the caller chose.
    Value<std::string> chosen_size_, chosen_technique_, chosen_detail_;
    LightCasters casters_;
    ShadowLookUp look_up_;
    bool is_shadowed_ = false;
    ShadowQuery query_;
    const Resource* transmittance_ = nullptr;
};

}  // namespace opacity::render
