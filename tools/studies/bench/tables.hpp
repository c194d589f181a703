#pragma once

#include <graze/instruction_set.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/run.hpp"

namespace graze::bench {

/// Describes the machine and the builds of a measurement.
struct Surroundings {
  std::string processor, compiler, flags, peer_flags;
  std::string instruction_sets;  ///< graze's, that of the name alone first
};
Surroundings surroundings(const PeerModule& module, std::span<const InstructionSet> sets);

std::string heading(const Surroundings& surroundings);
std::string table_of(const Run& run);
nlohmann::ordered_json figures_of(const Surroundings& surroundings);
nlohmann::ordered_json figures_of(const Run& run);
/// One line for each contender of each run, below a line of names.
std::string csv_of(const std::vector<Run>& runs);

}  // namespace graze::bench
