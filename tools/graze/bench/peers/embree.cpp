#include <embree3/rtcore.h>

#include "bench/peers/lazy_trees.hpp"
#include "bench/peers/peers.hpp"

namespace graze::bench {
namespace {

/// Embree's own threads stay away: objects and pairs are what is divided between threads.
RTCDevice device() {
  static const RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  return device;
}

/// Embree: a scene for each object with one user geometry, a primitive for each vertex or triangle, refitted;
/// pairs of scenes by rtcCollide.
class EmbreeTree {
 public:
  EmbreeTree(const World& world, Task task, std::uint32_t object)
      : parts_(world, task, object), scene_(rtcNewScene(device())) {
    geometry_ = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_REFIT);
    rtcSetGeometryUserPrimitiveCount(geometry_, parts_.count());
    rtcSetGeometryUserData(geometry_, &parts_);
    rtcSetGeometryBoundsFunction(geometry_, write_bounds, nullptr);
    rtcCommitGeometry(geometry_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_,
                            RTC_BUILD_QUALITY_LOW);  // a tree for each geometry: the kind that is refitted
    rtcAttachGeometry(scene_, geometry_);
    rtcCommitScene(scene_);
  }
  ~EmbreeTree() {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
  }
  EmbreeTree(const EmbreeTree&) = delete;
  EmbreeTree& operator=(const EmbreeTree&) = delete;

  void update() {
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }

  void match(EmbreeTree& other, Found& found) {
    Match match{&parts_, &other.parts_, &found};
    rtcCollide(scene_, other.scene_, take, &match);
  }

 private:
  struct Match {
    const Parts* parts;
    const Parts* other;
    Found* found;
  };

  static void write_bounds(const RTCBoundsFunctionArguments* arguments) {
    const FloatBox box = static_cast<const Parts*>(arguments->geometryUserPtr)->grown_box(arguments->primID);
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = box.min[0];
    bounds.lower_y = box.min[1];
    bounds.lower_z = box.min[2];
    bounds.upper_x = box.max[0];
    bounds.upper_y = box.max[1];
    bounds.upper_z = box.max[2];
  }
  static void take(void* user, RTCCollision* collisions, unsigned count) {
    const Match& match = *static_cast<const Match*>(user);
    for (unsigned i = 0; i < count; ++i)
      match.parts->test(collisions[i].primID0, *match.other, collisions[i].primID1, *match.found);
  }

  Parts parts_;
  RTCScene scene_;
  RTCGeometry geometry_ = nullptr;
};

}  // namespace

std::unique_ptr<Contender> make_embree(const World& world, Task task, unsigned threads) {
  return std::make_unique<LazyTrees<EmbreeTree>>(world, task, threads);
}

}  // namespace graze::bench
