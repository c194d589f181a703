#pragma once

#include <cstdint>
#include <graze/instruction_set.hpp>
#include <memory>
#include <vector>

#include "bench/contender.hpp"
#include "bench/scenes/scenes.hpp"

namespace graze::bench {

/// Task B by what another finds near and graze's own kernels: shows what of graze's time the hierarchy wins
/// and what the kernels. One thread.
///
/// `candidates` lists pairs of triangles, those of one pair of objects and of one triangle of a one after the
/// other. Every vertex and edge belongs to the first triangle that has it. What belongs to a triangle is
/// tested with what belongs to those near it, as graze tests two leaves.
std::unique_ptr<Contender> make_candidate_kernels(const BenchScene& scene, const World& world,
                                                  std::unique_ptr<Contender> candidates, InstructionSet set);

}  // namespace graze::bench
