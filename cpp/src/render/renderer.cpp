#include "opacity/renderer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>

#include "opacity/core/error.hpp"
#include "render/cpu_device.hpp"
#include "render/frame.hpp"
#include "render/gl_device.hpp"

namespace opacity {

struct Renderer::Impl {
    std::shared_ptr<Scene> scene;
    Camera camera;
    std::shared_ptr<Technique> technique;
    std::shared_ptr<gl::Context> context;  // none: on the CPU
    std::mutex busy;
    RenderSettings settings;
    float4 background{0.f, 0.f, 0.f, 0.f};
    std::int64_t most_texels = 0;  // along a side of a texture
    ShapeQuery shape_query;

    // Made with the context current; what they own may be freed without it (gl/object.hpp).
    std::unique_ptr<Device> device;
    std::unique_ptr<render::Frame> frame;

    Impl(std::shared_ptr<Scene> s, const Camera& c, std::shared_ptr<Technique> t,
         std::shared_ptr<gl::Context> x)
        : scene{std::move(s)}, camera{c}, technique{std::move(t)}, context{std::move(x)} {
        if (!scene)
            throw ParameterError("the renderer got no scene", "pass a Scene; an empty one will do");
        if (!technique) technique = make_technique("bounding_opacity_maps");
        const Turn now = turn();
        if (context) {
            for (const auto& [name, limit] : context->limits())
                if (name == "texture size") most_texels = limit;
            device = std::make_unique<render::GlDevice>(context);
        } else {
            device = std::make_unique<render::CpuDevice>();
        }
        frame = std::make_unique<render::Frame>(*device);
    }

    // As long as it lives, the context is current; on the CPU, other threads wait.
    struct Turn {
        std::unique_ptr<gl::Context::Use> use;
        std::unique_lock<std::mutex> lock;
    };
    Turn turn() {
        if (context) return {std::make_unique<gl::Context::Use>(*context), {}};
        return {nullptr, std::unique_lock{busy}};
    }

    gl::Context& require_context() const {
        if (!context)
            throw ContextError("the renderer was made for the CPU, and has no OpenGL context",
                               "make one with device=\"gpu\"; on the CPU ask for transmittance");
        return *context;
    }

    render::FrameInputs inputs() const { return {*scene, camera, technique, settings, background}; }

    void transmittance(const Query& query, int light, std::span<float> out) {
        const std::size_t expected = channels() * query.world_points.size();
        if (out.size() != expected)
            throw ParameterError("T there has " + std::to_string(expected) +
                                     " floats, the buffer " + std::to_string(out.size()),
                                 "pass as many as there are points, times channels()");
        frame->transmittance(inputs(), query, std::size_t(light), out);
    }
    std::vector<float> transmittance(const Query& query, int light) {
        std::vector<float> result(channels() * query.world_points.size());
        transmittance(query, light, result);
        return result;
    }
    std::size_t channels() const { return scene->is_tinted() ? channel_names.size() : 1; }

    std::vector<float> coverage() {
        check_size(settings.antialiasing.get());
        std::vector<float> rgba(std::size_t(4) * settings.width.get() * settings.height.get());
        const float4 nothing{};
        frame->render({*scene, camera, technique, settings, nothing}, rgba);
        std::vector<float> alpha(rgba.size() / 4);
        for (std::size_t i = 0; i < alpha.size(); ++i) alpha[i] = rgba[4 * i + 3];
        return alpha;
    }

    std::vector<float> first_surfaces(std::string_view name, int light) {
        constexpr std::array<std::string_view, 3> channels{"transmittance", "depth", "object_id"};
        const auto channel = std::find(channels.begin(), channels.end(), name);
        if (channel == channels.end())
            throw ParameterError(
                "there is no image \"" + std::string{name} + "\"",
                "choose \"transmittance\", \"depth\", \"coverage\" or \"object_id\"");
        check_size(1);
        const auto seen = frame->first_surfaces(inputs(), std::size_t(light));
        std::vector<std::vector<float>> values;
        for (const std::vector<float4>& surfaces : seen) {
            values.emplace_back();
            for (const float4& s : surfaces) {
                const bool is_nothing = name == "depth" && s[2] < 0.f;
                values.back().push_back(is_nothing ? std::numeric_limits<float>::infinity()
                                                   : s[std::size_t(channel - channels.begin())]);
            }
            if (name != "transmittance") break;  // where things are has no colour
        }
        return side_by_side(std::move(values));
    }

    // The picture is drawn oversampled: both together must fit a texture.
    void check_size(int samples) const {
        const int largest = std::max(settings.width.get(), settings.height.get());
        if (largest * std::int64_t{samples} <= most_texels) return;
        throw ParameterError(
            "a picture of " + std::to_string(largest) + " pixels along a side at antialiasing " +
                std::to_string(samples) + " needs " + std::to_string(largest * samples) +
                " texels; this driver has " + std::to_string(most_texels),
            "lower antialiasing to " +
                std::to_string(std::max<std::int64_t>(1, most_texels / largest)) + ", or the size");
    }

    void check_light(int light) const {
        const int count = int(scene->lights().size());
        if (light < 0 || light >= std::max(count, 1))
            throw ParameterError(
                "light = " + std::to_string(light) + " of " + std::to_string(count),
                "count from 0, or add a light to the scene");
    }
};

Renderer::Renderer(std::shared_ptr<Scene> scene, const Camera& camera,
                   std::shared_ptr<Technique> technique, std::shared_ptr<gl::Context> context)
    : impl_{std::make_unique<Impl>(std::move(scene), camera, std::move(technique),
                                   context ? std::move(context) : gl::Context::headless())} {}
Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
Renderer Renderer::on_cpu(std::shared_ptr<Scene> scene, std::shared_ptr<Technique> technique,
                          const Camera* camera) {
    const Camera used = camera ? *camera : Camera::fit(scene ? *scene : Scene{});
    return Renderer{std::make_unique<Impl>(std::move(scene), used, std::move(technique), nullptr)};
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

RenderSettings& Renderer::settings() {
    return impl_->settings;
}
Scene& Renderer::scene() {
    return *impl_->scene;
}
Technique& Renderer::technique() {
    return *impl_->technique;
}
std::size_t Renderer::channels() const {
    return impl_->channels();
}
const Camera& Renderer::camera() const {
    return impl_->camera;
}
bool Renderer::is_on_cpu() const {
    return !impl_->context;
}
gl::Context& Renderer::context() {
    return impl_->require_context();
}
void Renderer::set_camera(const Camera& camera) {
    impl_->camera = camera;
}
const float4& Renderer::background() const {
    return impl_->background;
}

void Renderer::set_technique(std::shared_ptr<Technique> technique) {
    if (!technique) throw ParameterError("no technique was given", "pass one from make_technique");
    impl_->technique = std::move(technique);
}

void Renderer::set_size(int width_px, int height_px) {
    RenderSettings& settings = impl_->settings;
    const ParamValue old_width = settings.width.value();
    settings.width.assign(std::int64_t{width_px});
    try {
        settings.height.assign(std::int64_t{height_px});
    } catch (...) {
        settings.width.assign(old_width);
        throw;
    }
}

void Renderer::set_background(const float4& rgba) {
    for (int i = 0; i < 4; ++i)
        if (!(rgba[i] >= 0.f && std::isfinite(rgba[i])) || (i == 3 && rgba[i] > 1.f))
            throw ParameterError(
                "background[" + std::to_string(i) + "] = " + std::to_string(rgba[i]),
                "choose linear RGB of 0 or more, and alpha in 0..1");
    impl_->background = rgba;
}

Image Renderer::render() {
    Image image{impl_->settings.width.get(), impl_->settings.height.get(), {}};
    image.rgba.resize(std::size_t(4) * image.width * image.height);
    render(image.rgba);
    return image;
}

void Renderer::render(std::span<float> rgba) {
    const std::size_t expected =
        std::size_t(4) * impl_->settings.width.get() * impl_->settings.height.get();
    if (rgba.size() != expected)
        throw ParameterError("the picture has " + std::to_string(expected) +
                                 " floats, the buffer " + std::to_string(rgba.size()),
                             "pass 4 * width * height floats");
    const gl::Context::Use use{impl_->require_context()};
    impl_->check_size(impl_->settings.antialiasing.get());
    impl_->frame->render(impl_->inputs(), rgba);
}

std::vector<float> Renderer::transmittance(const Positions& world_points, int light) {
    impl_->check_light(light);
    const auto now = impl_->turn();
    return impl_->transmittance(Query::at(world_points, *impl_->scene), light);
}
void Renderer::transmittance(const Positions& world_points, int light, std::span<float> out) {
    impl_->check_light(light);
    const auto now = impl_->turn();
    impl_->transmittance(Query::at(world_points, *impl_->scene), light, out);
}

std::vector<float> Renderer::transmittance(const Shape& shape, int light) {
    impl_->check_light(light);
    const auto now = impl_->turn();
    return impl_->transmittance(impl_->shape_query.at(shape, *impl_->scene), light);
}
void Renderer::transmittance(const Shape& shape, int light, std::span<float> out) {
    impl_->check_light(light);
    const auto now = impl_->turn();
    impl_->transmittance(impl_->shape_query.at(shape, *impl_->scene), light, out);
}

std::vector<float> Renderer::image(std::string_view name, int light) {
    const gl::Context::Use use{impl_->require_context()};
    impl_->check_light(light);
    return name == "coverage" ? impl_->coverage() : impl_->first_surfaces(name, light);
}

PictureReceivers Renderer::receivers() {
    const gl::Context::Use use{impl_->require_context()};
    impl_->check_size(1);
    return impl_->frame->receivers(impl_->inputs());
}

double4x4 Renderer::light_from_world(int light) const {
    impl_->check_light(light);
    return impl_->frame->light_from_world(std::size_t(light));
}
std::vector<double> Renderer::texel_sides(const Positions& world_points, int light) const {
    impl_->check_light(light);
    return impl_->frame->texel_sides(world_points, std::size_t(light));
}
const Report& Renderer::report() const {
    return impl_->frame->graph().report();
}
std::vector<ResourceMemory> Renderer::memory() const {
    return impl_->frame->graph().memory();
}
std::string Renderer::graph_dot() const {
    return impl_->frame->graph().graph_dot();
}
void Renderer::invalidate() {
    impl_->frame->graph().invalidate();
}
void Renderer::set_interrupt_check(std::function<void()> check) {
    impl_->frame->graph().set_interrupt_check(std::move(check));
}
void Renderer::needs_recompute() {
    impl_->technique->needs_recompute();
    for (const LightPtr& light : impl_->scene->lights())
        if (light->technique()) light->technique()->needs_recompute();
}

TextureContent Renderer::read(const std::string& name) const {
    const auto now = impl_->turn();
    const Texture& texture = impl_->frame->graph().find(name);
    const TextureDesc& desc = texture.desc();
    const int scale = content_scale(desc);
    TextureContent content{
        scale * desc.width, scale * desc.height, desc.layers, opacity::channels(desc.format), {}};
    std::vector<std::uint32_t> words(size_bytes(desc) / 4);
    impl_->device->read(texture, std::as_writable_bytes(std::span{words}));
    content.values.resize(words.size());
    for (std::size_t i = 0; i < words.size(); ++i)
        content.values[i] =
            desc.format == Format::r32ui ? float(words[i]) : std::bit_cast<float>(words[i]);
    return content;
}

}  // namespace opacity
