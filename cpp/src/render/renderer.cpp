#include "opacity/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "opacity/core/error.hpp"
#include "render/frame.hpp"
#include "render/gl_device.hpp"
#include "render/light_fit.hpp"
#include "render/scene_lists.hpp"

namespace opacity {

struct Renderer::Impl {
    std::shared_ptr<Scene> scene;
    Camera camera;
    std::shared_ptr<Technique> technique;
    std::shared_ptr<gl::Context> context;
    RenderSettings settings;
    float4 background{0.f, 0.f, 0.f, 0.f};

    // Made and destroyed with the context current, in this order and its reverse.
    std::unique_ptr<render::GlDevice> device;
    std::unique_ptr<render::Frame> frame;

    Impl(std::shared_ptr<Scene> s, const Camera& c, std::shared_ptr<Technique> t,
         std::shared_ptr<gl::Context> x)
        : scene{std::move(s)}, camera{c}, technique{std::move(t)}, context{std::move(x)} {
        if (!scene)
            throw ParameterError("the renderer got no scene", "pass a Scene; an empty one will do");
        if (!technique) technique = make_technique("bounding_opacity_maps");
        if (!context) context = gl::Context::headless();
        const gl::Context::Use use{*context};
        device = std::make_unique<render::GlDevice>(context);
        frame = std::make_unique<render::Frame>(*device);
    }
    ~Impl() {
        // Objects that die without their context are queued and freed with it (gl/object.hpp).
        frame.reset();
        device.reset();
    }

    render::FrameInputs inputs() const {
        return {*scene, camera, *technique, settings, background};
    }

    void check_light(int light) const {
        const int count = int(scene->lights().size());
        if (count > 1)
            throw ParameterError("the scene has " + std::to_string(count) + " lights",
                                 "keep one: this version renders one light");
        if (light < 0 || light >= std::max(count, 1))
            throw ParameterError(
                "light = " + std::to_string(light) + " of " + std::to_string(count),
                "count from 0, or add a DirectionalLight to the scene");
    }
};

Renderer::Renderer(std::shared_ptr<Scene> scene, const Camera& camera,
                   std::shared_ptr<Technique> technique, std::shared_ptr<gl::Context> context)
    : impl_{std::make_unique<Impl>(std::move(scene), camera, std::move(technique),
                                   std::move(context))} {}
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
const Camera& Renderer::camera() const {
    return impl_->camera;
}
gl::Context& Renderer::context() {
    return *impl_->context;
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
    impl_->check_light(0);
    const gl::Context::Use use{*impl_->context};
    impl_->frame->render(impl_->inputs(), rgba);
}

std::vector<float> Renderer::transmittance(const Positions& world_points, int light) {
    impl_->check_light(light);
    const std::size_t bad = world_points.first_bad();
    if (bad < world_points.size())
        throw ParameterError("points[" + std::to_string(bad) + "] is not finite",
                             "remove or repair the point");
    const gl::Context::Use use{*impl_->context};
    return impl_->frame->transmittance(impl_->inputs(), world_points);
}

double4x4 Renderer::light_from_world() const {
    return impl_->frame->light_from_world();
}
const Report& Renderer::report() const {
    return impl_->frame->graph().report();
}
std::string Renderer::dot() const {
    return impl_->frame->graph().dot();
}
void Renderer::invalidate() {
    impl_->frame->graph().invalidate();
}
void Renderer::set_interrupt_check(std::function<void()> check) {
    impl_->frame->graph().set_interrupt_check(std::move(check));
}
void Renderer::needs_recompute() {
    impl_->technique->needs_recompute();
}

TextureContent Renderer::read(const std::string& name) const {
    const gl::Context::Use use{*impl_->context};
    const Texture& texture = impl_->frame->graph().find(name);
    const TextureDesc& desc = texture.desc();
    TextureContent content{desc.width, desc.height, desc.layers, channels(desc.format), {}};
    std::vector<std::uint32_t> words(size_bytes(desc) / 4);
    impl_->device->read(texture, std::as_writable_bytes(std::span{words}));
    content.values.resize(words.size());
    for (std::size_t i = 0; i < words.size(); ++i)
        content.values[i] =
            desc.format == Format::r32ui ? float(words[i]) : std::bit_cast<float>(words[i]);
    return content;
}

}  // namespace opacity
