#include <array>

#include "bench/peers/peers.hpp"

namespace graze::bench {
namespace {

constexpr double as_double = 0;

const PeerEntry entries[] = {
    {read_limit, "ABD", make_read_limit, as_double},
    {box_limit, "ABD", make_box_limit, as_double},
    {movers_limit, "ABD", make_movers_limit, as_double},
    {"clipping", "AB", make_clipping, as_double},
    {clipping_candidates, "", make_clipping_candidates, as_double},
    {"row grid", "A", make_row_grid, as_double},
#if GRAZE_BENCH_EMBREE
    {"Embree", "AB", make_embree, as_double},
#endif
#if GRAZE_BENCH_BULLET
    {"Bullet", "AB", make_bullet, as_double},
#endif
#if GRAZE_BENCH_NANOFLANN
    {"nanoflann", "A", make_nanoflann, as_double},
#endif
#if GRAZE_BENCH_FCL
    {"FCL", "BD", make_fcl, 1e-9},
#endif
#if GRAZE_BENCH_CGAL
    {"CGAL", "B", make_cgal, as_double},
#endif
};

}  // namespace

std::unique_ptr<Contender> make_clipping(const World& world, Task task, unsigned threads) {
  return task == Task::A ? make_clipping_vertices(world, threads) : make_clipping_triangles(world, threads);
}

}  // namespace graze::bench

extern "C" [[gnu::visibility("default")]] void graze_bench_peers(graze::bench::PeerList& list,
                                                                 std::string_view& compiled_for) {
  list = graze::bench::entries;
  compiled_for = GRAZE_BENCH_COMPILED_FOR;
}
