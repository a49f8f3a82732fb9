#include "render/feed_shape.hpp"

#include <algorithm>
#include <glm/glm.hpp>

#include "core/glm_matrix.hpp"
#include "map/voxels.hpp"

namespace opacity::render {
namespace {

template <class Matrix>
std::vector<float> to_floats(const Matrix& m) {
    std::vector<float> values;
    for (int column = 0; column < m.length(); ++column)
        for (int row = 0; row < m.length(); ++row) values.push_back(float(m[column][row]));
    return values;
}

float widening(const View& view, const GpuShape& gpu) {
    return gpu.ranks ? float(gpu.ranks->widening(view.strand_detail())) : 1.f;
}

void feed_view(ProgramFeeder& feeder, const View& view, const GpuShape& gpu) {
    glm::dmat4 to_world = to_glm(gpu.transform);
    to_world[3] = to_world * glm::dvec4{gpu.origin[0], gpu.origin[1], gpu.origin[2], 1.0};
    const glm::dmat4 from_local = to_glm(view.from_world()) * to_world;
    const std::string name = "u_" + view.shader_name();
    feeder.uniform(name + "_from_local", to_floats(from_local));
    const glm::dmat3 normal_from_local = glm::transpose(glm::inverse(glm::dmat3{from_local}));
    feeder.uniform(name + "_normal_from_local", to_floats(normal_from_local));
    feeder.uniform(name + "_strand_detail", float(view.strand_detail()));
    feeder.uniform(name + "_strand_widening", widening(view, gpu));
    if (!gpu.extinction.object) return;
    const VoxelSpace voxels = voxel_space(view.from_world(), gpu.transform, gpu.local_from_voxels);
    feeder.uniform(name + "_from_voxels", to_floats(to_glm(voxels.from_voxels)));
    feeder.uniform("u_voxels_from_" + view.shader_name(), to_floats(to_glm(voxels.to_voxels)));
}

bool declared(const Pass& pass, const Source& source) {
    return std::find(pass.reads.begin(), pass.reads.end(), &source) != pass.reads.end();
}

}  // namespace

void feed_shape(ProgramFeeder& feeder, const Pass& pass, const GpuShape& gpu) {
    const auto feed_buffer = [&](const char* name, const GpuBuffer& part) {
        if (part.object) feeder.buffer(name, part.object->name());
    };
    const auto feed_texture = [&](const char* name, const GpuTexture& part) {
        if (part.object) feeder.texture(name, part.object->name());
    };
    feed_buffer("points", gpu.points);
    feed_buffer("segments", gpu.segments);
    feed_buffer("normals", gpu.normals);
    feed_buffer("uvs", gpu.uvs);
    feed_buffer("slabs", gpu.slabs);
    feed_buffer("strand_ranks", gpu.strand_ranks);
    feed_texture("alpha", gpu.alpha);
    feed_texture("extinction", gpu.extinction);
    feeder.uniform("u_voxel_size", std::vector<float>{float(gpu.spacing[0]), float(gpu.spacing[1]),
                                                      float(gpu.spacing[2])});
    feeder.uniform("u_segment_count", gpu.segment_count);
    const bool as_seen = pass.view && !pass.draws_unseen;
    feeder.uniform("u_width_scale", gpu.width_scale * (as_seen ? widening(*pass.view, gpu) : 1.f));
    feeder.uniform("u_profile", gpu.profile);
    feeder.uniform("u_receiver_width", gpu.receiver_width);
    if (declared(pass, pass.draws->opacity)) {
        feed_buffer("opacity", gpu.opacity);
        feeder.uniform("u_opacity_stride", gpu.opacity_stride);
    }
    if (declared(pass, pass.draws->color)) {
        feed_buffer("color", gpu.color);
        feed_texture("color_map", gpu.color_map);
        feeder.uniform("u_color_stride", gpu.color_stride);
    }
    if (pass.view) feed_view(feeder, *pass.view, gpu);
    for (const Source* read : pass.reads)
        if (const auto* view = dynamic_cast<const View*>(read)) feed_view(feeder, *view, gpu);
}

}  // namespace opacity::render
