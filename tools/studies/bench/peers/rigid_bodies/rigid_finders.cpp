#include "bench/peers/rigid_bodies/rigid_finders.hpp"

namespace graze::bench {
namespace {

const RigidContactEntry entries[] = {
    {"clipped faces", true, true, make_clipped_faces},
#if GRAZE_BENCH_BULLET_RIGID
    {"Bullet's boxes", true, false, make_bullet_boxes},
    {"Bullet's hulls", true, true, make_bullet_hulls},
    {"Bullet's GImpact", false, true, make_bullet_meshes},
#endif
};

}  // namespace
}  // namespace graze::bench

extern "C" [[gnu::visibility("default")]] void graze_bench_rigid_contacts(
    std::span<const graze::bench::RigidContactEntry>& entries) {
  entries = graze::bench::entries;
}
