#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/run.hpp"

namespace graze::bench {

/// Where and how it was measured.
struct Surroundings {
  std::string processor, compiler, flags, peer_flags, instruction_set;
};
Surroundings surroundings(const PeerModule& module);

std::string heading(const Surroundings& surroundings);
std::string table_of(const Run& run);
nlohmann::ordered_json figures_of(const Surroundings& surroundings);
nlohmann::ordered_json figures_of(const Run& run);
/// One line for each contender of each run, below a line of names.
std::string csv_of(const std::vector<Run>& runs);

}  // namespace graze::bench
