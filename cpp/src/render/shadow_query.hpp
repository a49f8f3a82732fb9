// Asks the maps for T at receivers: the pass "transmittance", with its shader or in C++.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "map/receiver.hpp"
#include "opacity/technique.hpp"

namespace opacity::render {

// How T is looked up, and the shader that defines shadow_transmittance.
struct ShadowLookUp : LookUp {
    std::string shader = "techniques/unshadowed.glsl";
    // Of the first opaque casters: where they are, and moved back for bare points.
    const Texture *opaque_depth = nullptr, *opaque_moved = nullptr;
};

class ShadowQuery {
   public:
    explicit ShadowQuery(const std::string& asked) : asked_{asked} {}
    // `technique` and `space` are those of the look-up, and outlive the frame.
    const Resource& add(FrameGraph& graph, const ShadowLookUp& look_up, const Technique& technique,
                        const LightSpace& space, const View& light);
    // What the next run of the pass answers; asked the same again, it stays cached.
    void ask(const LightSpace& space, const Query& query, bool own_correction);
    const std::vector<float>& answers() const { return transmittance_; }

    struct Buffers {
        Buffer &query, &transmittance;
    };
    struct Asked {
        ShadowLookUp look_up;
        const Technique& technique;
        const LightSpace& space;
        Buffers buffers;
    };

   private:
    void ask_all(PassContext& context, const Asked& asked);
    void dispatch(PassContext& context, std::size_t first, std::size_t count,
                  Uniforms more = {}) const;
    // Of receivers that fit one storage buffer: all at once, or slab by slab.
    std::vector<float> ask(PassContext& context, const Asked& asked,
                           std::span<const Receiver> receivers) const;
    std::vector<float> sweep(PassContext& context, const Asked& asked,
                             std::span<const Receiver> receivers) const;
    void look_up_all(PassContext& context, const Asked& asked);
    void sweep_on_cpu(PassContext& context, const Asked& asked);

    // What the receivers of a shape's points follow from.
    struct Cause {
        Revision placed = 0, opacity = 0;
        bool is_in_maps = false, own_correction = false;
        LightSpace space;
        bool operator==(const Cause&) const = default;
    };
    bool update_receivers(const LightSpace& space, const Query& query, bool own_correction);
    void note_outside(PassContext& context) const;

    UniformSet asked_;
    std::optional<Cause> cause_;  // none: the last were not a shape's
    std::vector<Receiver> receivers_;
    std::size_t outside_ = 0;  // of these, the map
    float receiver_width_ = 0.f;
    std::vector<float> transmittance_;
};

}  // namespace opacity::render
