// T along strands, looked up every third texel of a light's map: once for as long as neither the
// light nor what casts moves, whatever the camera does. A picture's samples on strands then read
// two of these places, which costs next to nothing beside a look-up in the maps; and the mean of
// two places errs less than one look-up does (docs/accuracy.md, "Along strands").
//
// Cost: a look-up a place, 4 bytes. Fails: where strands are so far away that they have many more
// places than samples.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "opacity/scene/strands.hpp"
#include "render/picture_inputs.hpp"

namespace opacity::render {

class StrandShadows {
   public:
    void begin_frame();
    // Declares the pass for the strands of a list under a light of that index, where the settings
    // want it.
    void add(FrameGraph& graph, const PictureInputs& inputs, const std::string& name,
             std::size_t light, DrawList& shapes);
    // Makes a pass that draws the list by the light read them, if there are any.
    void add_look_up(Pass& pass, std::size_t light, const DrawList& shapes) const;

   private:
    // Of a list: the first place of each shape and its steps a segment, one after the other.
    struct Places {
        std::vector<int> of_shapes;
        std::size_t count = 0;
        double samples = 0.0;  // of a picture that shows all of them
    };
    static bool is_wanted(const RenderSettings& settings, const Places& places,
                          double most_places_a_sample);
    Places places_on(const DrawList& shapes, const LightSpace& space, const PictureInputs& inputs);
    double segment_length(const Strands& strands);
    DrawList& strands_of(const DrawList& shapes);

    struct Buffers {
        const Buffer &places, &transmittance;
    };
    Buffers add_pass(FrameGraph& graph, const LightMaps& light, const Places& found,
                     const DrawList& shapes);
    std::map<std::pair<std::size_t, const DrawList*>, Buffers> places_;
    std::map<const DrawList*, DrawList> strands_;  // of each list, what has places
    // Of segments, in the shape's units, by the revision of its geometry: of the frame before, and
    // of this one.
    std::map<Revision, double> known_lengths_, lengths_;
};

}  // namespace opacity::render
