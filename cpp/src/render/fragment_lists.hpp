// Exact compositing: every sample that the camera meets, in a list of its texel, sorted on the CPU.
// The reference of the other ways: what it costs is no object.
#pragma once

#include "render/shading.hpp"

namespace opacity::render {

class FragmentLists {
   public:
    // Into a layer a light of `over`: premultiplied colours. OutOfMemoryError where the lists would
    // be too long.
    void add(FrameGraph& graph, const PictureInputs& inputs, const Shading& shading,
             const Texture& solid_depth, Texture& over);

   private:
    // Of one light; how many samples a texel has, and where its list begins, is the same for all.
    struct Lists {
        const Texture *colors, *distances;
    };
    struct Places {
        Texture &count, &first;
        Value<int>& samples;
    };
    Places add_places(FrameGraph& graph, const PictureInputs& inputs, const Shading& shading,
                      const Texture& solid_depth) const;
    Lists add_store(FrameGraph& graph, const PictureInputs& inputs, const Shading& shading,
                    const Texture& solid_depth, const Places& places, std::size_t light) const;
};

}  // namespace opacity::render
