// Embree 3 or 4 as the hierarchy of boxes. It knows no strand and no triangle: each primitive is a
// box to it, so that the geometric rule stands in one place, and in float64.
#include "rays/backend.hpp"

#ifdef OPACITY_EMBREE
#if OPACITY_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <exception>
#include <limits>

#include "opacity/core/error.hpp"

namespace opacity::rays {
namespace {

#if OPACITY_EMBREE >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

constexpr float infinity = std::numeric_limits<float>::infinity();

// What Embree hands to the callback of one ray; its own part comes first.
struct Query {
    Context context;
    Hits* hits;
    std::exception_ptr thrown;
};

const Piece& piece(const void* pieces, unsigned index) {
    return static_cast<const Piece*>(pieces)[index];
}

void write_bounds(const RTCBoundsFunctionArguments* arguments) {
    const Piece& box = piece(arguments->geometryUserPtr, arguments->primID);
    *arguments->bounds_o = {box.min[0], box.min[1], box.min[2], 0.f,
                            box.max[0], box.max[1], box.max[2], 0.f};
}

// Never reports a hit, so that Embree goes on to the next box; a ray that ends here is enough.
void visit(const RTCOccludedFunctionNArguments* arguments) {
    auto& query = *reinterpret_cast<Query*>(arguments->context);
    bool go_on = false;
    try {
        go_on = query.hits->visit(piece(arguments->geometryUserPtr, arguments->primID).primitive);
    } catch (...) {  // not through a library that knows no exceptions
        query.thrown = std::current_exception();
    }
    if (!go_on) RTCRayN_tfar(arguments->ray, arguments->N, 0) = -infinity;
}

bool may_go_on(void* stop, double) {
    return !(*static_cast<const Stop*>(stop))();
}

class Embree : public Backend {
   public:
    Embree(const Casters& casters, const Stop& stop)
        : pieces_{pieces_of(casters)}, device_{rtcNewDevice(nullptr)} {
        if (!device_)
            throw OutOfMemoryError("Embree could not start", "choose backend=\"builtin\"");
        RTCGeometry boxes = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(boxes, unsigned(pieces_.size()));
        rtcSetGeometryUserData(boxes, pieces_.data());
        rtcSetGeometryBoundsFunction(boxes, write_bounds, nullptr);
        rtcSetGeometryOccludedFunction(boxes, visit);
        rtcCommitGeometry(boxes);
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneProgressMonitorFunction(scene_, may_go_on, const_cast<Stop*>(&stop));
        rtcAttachGeometry(scene_, boxes);
        rtcReleaseGeometry(boxes);
        rtcCommitScene(scene_);
        const RTCError error = rtcGetDeviceError(device_);
        if (error == RTC_ERROR_NONE || error == RTC_ERROR_CANCELLED) return;
        release();
        throw OutOfMemoryError("Embree could not hold the scene, error " + std::to_string(error),
                               "choose backend=\"builtin\"");
    }
    ~Embree() override { release(); }

    void search(Hits& hits, const Reach& reach) const override {
        const Ray& ray = hits.ray();
        RTCRay shadow{};
        shadow.org_x = float(reach.start[0]);
        shadow.org_y = float(reach.start[1]);
        shadow.org_z = float(reach.start[2]);
        shadow.dir_x = float(ray.toward[0]);
        shadow.dir_y = float(ray.toward[1]);
        shadow.dir_z = float(ray.toward[2]);
        shadow.tfar = float(reach.length);
        shadow.mask = ~0u;
        Query query{{}, &hits, {}};
        occluded(shadow, query.context);
        if (query.thrown) std::rethrow_exception(query.thrown);
    }

   private:
    void occluded(RTCRay& ray, Context& context) const {
#if OPACITY_EMBREE >= 4
        rtcInitRayQueryContext(&context);
        RTCOccludedArguments arguments;
        rtcInitOccludedArguments(&arguments);
        arguments.context = &context;
        rtcOccluded1(scene_, &ray, &arguments);
#else
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene_, &context, &ray);
#endif
    }
    void release() {
        if (scene_) rtcReleaseScene(scene_);
        if (device_) rtcReleaseDevice(device_);
    }

    std::vector<Piece> pieces_;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<Backend> build_embree(const Casters& casters, const Stop& stop) {
    return std::make_unique<Embree>(casters, stop);
}

bool has_embree() {
    return true;
}

}  // namespace opacity::rays

#else

namespace opacity::rays {

std::unique_ptr<Backend> build_embree(const Casters&, const Stop&) {
    return {};
}

bool has_embree() {
    return false;
}

}  // namespace opacity::rays

#endif
