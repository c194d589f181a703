#pragma once

#include <memory>

#include "bench/contender.hpp"

// Every contender of the module, by what makes it. A peer's own file is built only where its package is
// installed.
namespace graze::bench {

/// Reads all positions once.
std::unique_ptr<Contender> make_read_limit(const World& world, Task task, unsigned threads);
/// Makes one box of each object, from all positions.
std::unique_ptr<Contender> make_box_limit(const World& world, Task task, unsigned threads);

/// Reads the positions of what moves and of what is near that. What these are is found once.
std::unique_ptr<Contender> make_movers_limit(const World& world, Task task, unsigned threads);

std::unique_ptr<Contender> make_clipping(const World& world, Task task, unsigned threads);
std::unique_ptr<Contender> make_clipping_vertices(const World& world, unsigned threads);
std::unique_ptr<Contender> make_clipping_triangles(const World& world, unsigned threads);
std::unique_ptr<Contender> make_clipping_candidates(const World& world, Task task, unsigned threads);
std::unique_ptr<Contender> make_row_grid(const World& world, Task task, unsigned threads);

std::unique_ptr<Contender> make_embree(const World& world, Task task, unsigned threads);
std::unique_ptr<Contender> make_bullet(const World& world, Task task, unsigned threads);
std::unique_ptr<Contender> make_nanoflann(const World& world, Task task, unsigned threads);
std::unique_ptr<Contender> make_fcl(const World& world, Task task, unsigned threads);
std::unique_ptr<Contender> make_cgal(const World& world, Task task, unsigned threads);

}  // namespace graze::bench
