#include "render/light_view.hpp"

namespace opacity::render {
namespace {

// A matrix for each face, by columns: the columns of its axes, each with a number of the lens
// below; then the offset, with the depth of the origin.
std::vector<float> face_matrices(const LightSpace& space) {
    std::vector<float> values;
    for (const LightFace& face : space.faces) {
        const double lens[] = {face.focal_px, face.middle_px[0], face.middle_px[1]};
        for (std::size_t column = 0; column < 3; ++column) {
            for (std::size_t row = 0; row < 3; ++row)
                values.push_back(float(face.axes[3 * row + column]));
            values.push_back(float(lens[column]));
        }
        for (const double c : face.offset) values.push_back(float(c));
        values.push_back(float(face.depth_of_origin));
    }
    return values;
}

// Two offsets and the scale of each.
std::vector<float> split_vectors(const LightSpace& space) {
    std::vector<float> values;
    for (const LightSplit& split : space.splits)
        for (const double value : {split.offset_px[0], split.offset_px[1], split.scale})
            values.push_back(float(value));
    return values;
}

}  // namespace

void update_light_view(View& view, const LightSpace& space) {
    Uniforms uniforms{{"u_light_map_size_px", space.map_size_px},
                      {"u_light_depth_range", float(space.depth_range)},
                      {"u_light_texels_per_unit", float(space.texels_per_unit)},
                      {"u_light_least_bias", float(space.least_bias)}};
    if (!space.is_parallel()) {
        uniforms.emplace_back("u_light_faces", face_matrices(space));
        uniforms.emplace_back("u_light_faces_an_eye", space.faces_an_eye);
    }
    if (!space.splits.empty()) uniforms.emplace_back("u_light_splits", split_vectors(space));
    if (!space.is_one_map()) uniforms.emplace_back("u_light_columns", space.columns());
    view.set_strand_detail(space.strand_detail);
    view.update(space.from_world, std::move(uniforms), space.is_one_map() ? 0 : space.face_count());
}

}  // namespace opacity::render
