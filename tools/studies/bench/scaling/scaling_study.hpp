#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/contender.hpp"
#include "bench/scenes/scenes.hpp"
#include "figures/result_table.hpp"

namespace graze::bench {

/// Says how steps of scenes scale: what they are made of on one thread, what a model makes of that on more
/// processors, and what the threads of this machine give.
class ScalingStudy {
 public:
  /// `threads` are the numbers to measure. One thread is always measured.
  explicit ScalingStudy(std::vector<unsigned> threads);

  /// Measures a scene with one task. `frames` are 0 for the scene's own number.
  void add(const BenchScene& scene, Task task, std::size_t frames);

  /// The predictions and measurements, a row for each scene and task.
  [[nodiscard]] const tools::ResultTable& table() const { return table_; }
  /// The stages of one step, a row for each scene, task and stage.
  [[nodiscard]] const tools::ResultTable& stages() const { return stages_; }
  [[nodiscard]] const nlohmann::ordered_json& figures() const { return figures_; }

 private:
  std::vector<unsigned> threads_;
  tools::ResultTable table_;
  tools::ResultTable stages_;
  nlohmann::ordered_json figures_;
};

}  // namespace graze::bench
