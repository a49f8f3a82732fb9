#include "io/gltf_material.hpp"

#include <cmath>

#include "core/number_text.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

float checked(const JsonValue& where, double value, const Allowed& allowed) {
    if (allowed(value)) return float(value);
    throw where.error("is " + number_text(value) + ", which is not " + allowed.words,
                      std::string{"write a value that is "} + allowed.words);
}

AlphaMode mode_of(const JsonValue& value) {
    const std::string_view name = value.text("OPAQUE");
    if (name == "OPAQUE") return AlphaMode::opaque;
    if (name == "MASK") return AlphaMode::mask;
    if (name == "BLEND") return AlphaMode::blend;
    throw value.error("is no alpha mode", "write OPAQUE, MASK or BLEND");
}

// The factor of a blended surface is its opacity. A mask compares it with the cutoff, so that it
// moves the cutoff, and where even the most opaque texel is below, nothing is left.
void set_opacity(Surface& surface, float factor, float cutoff) {
    if (surface.alpha_mode == AlphaMode::blend) surface.opacity = factor;
    if (surface.alpha_mode != AlphaMode::mask) return;
    if (factor < cutoff)
        surface.opacity = 0.f;
    else
        surface.alpha_cutoff = factor > 0.f ? cutoff / factor : 0.f;
}

void read_uv_transform(const JsonValue& texture, GltfMaterial& material) {
    const JsonValue transform = texture["extensions"]["KHR_texture_transform"];
    material.uv_set = transform["texCoord"].whole_number(texture["texCoord"].whole_number(0));
    const auto [u, v] = transform["offset"].numbers<2>({0, 0});
    const auto [scale_u, scale_v] = transform["scale"].numbers<2>({1, 1});
    const double angle = transform["rotation"].number(0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    material.uv_transform = {c * scale_u, s * scale_v, u, -s * scale_u, c * scale_v, v};
}

}  // namespace

GltfMaterial read_gltf_material(GltfFile& file, const JsonValue& index) {
    GltfMaterial result;
    Surface& surface = result.surface;
    surface.color = {1, 1, 1};
    if (!index) return result;
    const JsonValue material = file.item("materials", index);
    const JsonValue model = material["pbrMetallicRoughness"];
    const JsonValue factor = model["baseColorFactor"];
    const auto rgba = factor.numbers<4>({1, 1, 1, 1});
    for (std::size_t i = 0; i < 3; ++i) surface.color[i] = checked(factor, rgba[i], brightness);
    surface.alpha_mode = mode_of(material["alphaMode"]);
    const JsonValue cutoff = material["alphaCutoff"];
    set_opacity(surface, checked(factor, rgba[3], unit_interval),
                checked(cutoff, cutoff.number(0.5), not_negative));

    const JsonValue texture = model["baseColorTexture"];
    if (!texture) return result;
    read_uv_transform(texture, result);
    const std::shared_ptr<PictureMaps> maps = file.picture(texture["index"]);
    if (!maps) {
        surface.color = neutral_grey;
        return result;
    }
    surface.color_map = maps->color();
    if (surface.alpha_mode != AlphaMode::opaque && maps->has_alpha())
        surface.alpha_map = maps->alpha();
    return result;
}

}  // namespace opacity
