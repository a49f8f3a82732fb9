// A picture as a surface's maps, each made when it is first asked for, and once.
#pragma once

#include "io/stb_decode.hpp"
#include "opacity/scene/texture_map.hpp"

namespace opacity {

class PictureMaps {
   public:
    explicit PictureMaps(Picture picture) : picture_{std::move(picture)} {}

    // Linear RGB: what a picture stores is sRGB.
    const TextureMapPtr& color();
    // The alpha channel; of a picture that has none, how light it is.
    const TextureMapPtr& alpha();
    // How light the picture is, from the values as they are stored.
    const TextureMapPtr& luminance();

    // Whether the alpha channel says anything: many files carry one that is the same everywhere.
    bool alpha_varies() const;
    bool has_alpha() const { return picture_.has_alpha(); }

   private:
    template <class Texel>
    TextureMapPtr map(int channels, const Texel& texel) const;

    Picture picture_;
    TextureMapPtr color_, alpha_, luminance_;
};

}  // namespace opacity
