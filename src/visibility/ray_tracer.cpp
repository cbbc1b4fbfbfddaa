#include <transillum/base/error.h>
#include <transillum/visibility/ray_tracer.h>

#include <embree3/rtcore.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <string>

namespace transillum {

namespace {

/// Roundings that meet in one intersection: vertices, the ray's origin and direction, Embree's own.
constexpr double clearance_ulps = 32.0;
constexpr double float_ulp = 0x1p-24;

double largest_component(const glm::dvec3& v) {
    const glm::dvec3 a = glm::abs(v);
    return std::max({a.x, a.y, a.z});
}

double towards(const glm::dvec3& normal, const glm::dvec3& direction) {
    return glm::dot(normal, direction) < 0.0 ? -1.0 : 1.0;
}

void set_ray(RTCRay& ray, const glm::vec3& origin, const glm::vec3& direction, float near,
             float far) {
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = near;
    ray.tfar = far;
    ray.time = 0.0f;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
}

}  // namespace

struct RayTracer::Impl {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = nullptr;
    glm::dvec3 centre{0.0};
    double half_extent = 0.0;

    explicit Impl(const SurfaceMesh& mesh) {
        find_bounds(mesh);
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        add_triangles(mesh);
        rtcCommitScene(scene);
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
            throw Error("Embree cannot build its tree over " +
                        std::to_string(mesh.triangles.size()) +
                        " triangles: out of memory or unsupported processor");
    }
    ~Impl() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void find_bounds(const SurfaceMesh& mesh) {
        if (mesh.positions.empty()) return;
        glm::dvec3 low = mesh.positions.front(), high = low;
        for (const glm::dvec3& p : mesh.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        centre = 0.5 * (low + high);
        half_extent = largest_component(high - centre);
    }

    void add_triangles(const SurfaceMesh& mesh) {
        if (mesh.triangles.empty()) return;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<glm::vec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(glm::vec3), mesh.positions.size()));
        auto* corners = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), mesh.triangles.size()));
        if (vertices != nullptr && corners != nullptr) {
            for (const glm::dvec3& p : mesh.positions) *vertices++ = local(p);
            for (const RootTriangle& t : mesh.triangles)
                corners = std::copy(t.vertices.begin(), t.vertices.end(), corners);
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
        }
        rtcReleaseGeometry(geometry);
    }

    /// Relative to the scene's centre, so that a scene far from the origin keeps its precision.
    [[nodiscard]] glm::vec3 local(const glm::dvec3& p) const { return glm::vec3(p - centre); }
};

RayTracer::RayTracer(const SurfaceMesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}

RayTracer::~RayTracer() = default;
RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer& RayTracer::operator=(RayTracer&&) noexcept = default;

Hit RayTracer::intersect(const Ray& ray) const {
    RTCRayHit query;
    set_ray(query.ray, impl_->local(ray.origin), glm::vec3(ray.direction), ray.min_distance,
            ray.max_distance);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(impl_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const float facing = query.hit.Ng_x * query.ray.dir_x + query.hit.Ng_y * query.ray.dir_y +
                         query.hit.Ng_z * query.ray.dir_z;
    return {query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar, facing > 0.0f};
}

bool RayTracer::occluded(const glm::dvec3& from, const glm::dvec3& from_normal,
                         const glm::dvec3& to, const glm::dvec3& to_normal) const {
    const double from_clearance = clearance(from), to_clearance = clearance(to);
    const glm::dvec3 way = to - from;
    const glm::dvec3 a = from + from_clearance * towards(from_normal, way) * from_normal;
    const glm::dvec3 b = to + to_clearance * towards(to_normal, -way) * to_normal;
    const double distance = glm::length(b - a);
    // A surface that meets one of the ends, as at the edge of a room, is not between them.
    const double near = from_clearance, far = distance - to_clearance;
    if (!(near < far)) return false;
    RTCRay ray;
    set_ray(ray, impl_->local(a), glm::vec3((b - a) / distance), static_cast<float>(near),
            static_cast<float>(far));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(impl_->scene, &context, &ray);
    return ray.tfar < 0.0f;
}

double RayTracer::clearance(const glm::dvec3& point) const {
    const double magnitude = std::max(impl_->half_extent, largest_component(point - impl_->centre));
    return clearance_ulps * float_ulp * magnitude;
}

}  // namespace transillum
