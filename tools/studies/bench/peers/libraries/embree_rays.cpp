#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "bench/rays/ray_caster.hpp"

namespace graze::bench {
namespace {

/// Embree: one scene of triangles, with a geometry for each object. Rays that pass through a common edge of
/// two triangles must hit one.
class EmbreeRays final : public RayCaster {
 public:
  EmbreeRays(const World& world, RayTree tree, unsigned threads)
      : world_(world),
        device_(rtcNewDevice(("threads=" + std::to_string(threads) + ",set_affinity=0").c_str())),
        scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
    if (tree == RayTree::refitted) rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    for (const WorldObject& object : world.objects) add(object, tree);
  }
  ~EmbreeRays() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeRays(const EmbreeRays&) = delete;
  EmbreeRays& operator=(const EmbreeRays&) = delete;

  void update() override {
    for (std::size_t i = 0; i < world_.objects.size(); ++i) {
      if (!is_first_ && world_.displacements[i] == 0) continue;
      const std::size_t bytes = 3 * sizeof(float) * world_.objects[i].vertex_count;
      std::memcpy(vertices_[i], world_.positions_of(i), bytes);
      const RTCGeometry geometry = rtcGetGeometry(scene_, static_cast<unsigned>(i));
      rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
      rtcCommitGeometry(geometry);
    }
    is_first_ = false;
    rtcCommitScene(scene_);
  }

  void cast(std::span<const Ray> rays, std::span<FirstHit> hits, unsigned /*thread*/) override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = first_hit(rays[i]);
  }

 private:
  void add(const WorldObject& object, RayTree tree) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (tree == RayTree::refitted && !object.is_fixed)
      rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
    vertices_.push_back(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                3 * sizeof(float), object.vertex_count));
    void* const triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                    sizeof(Triangle), object.triangles.size());
    std::memcpy(triangles, object.triangles.data(), object.triangles.size_bytes());
    rtcAttachGeometry(scene_, geometry);  // the numbers are those of the objects
    rtcReleaseGeometry(geometry);
  }

  [[nodiscard]] FirstHit first_hit(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.org_x = ray.origin[0];
    query.ray.org_y = ray.origin[1];
    query.ray.org_z = ray.origin[2];
    query.ray.dir_x = ray.direction[0];
    query.ray.dir_y = ray.direction[1];
    query.ray.dir_z = ray.direction[2];
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0U;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.hit.geomID, query.ray.tfar};
  }

  const World& world_;
  RTCDevice device_;
  RTCScene scene_;
  std::vector<void*> vertices_;  ///< of each object, Embree's own
  bool is_first_ = true;
};

}  // namespace
}  // namespace graze::bench

extern "C" [[gnu::visibility("default")]] void graze_bench_rays(
    const graze::bench::World& world, graze::bench::RayTree tree, unsigned threads,
    std::unique_ptr<graze::bench::RayCaster>& caster) {
  caster = std::make_unique<graze::bench::EmbreeRays>(world, tree, threads);
}
