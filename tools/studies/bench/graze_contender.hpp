#pragma once

#include <cstdint>
#include <graze/graze.hpp>
#include <graze/instruction_set.hpp>
#include <graze/recorder.hpp>
#include <optional>
#include <thread>
#include <vector>

#include "bench/contender.hpp"
#include "bench/scenes/scenes.hpp"
#include "scenes/report_hash.hpp"

namespace graze::bench {

/// How graze learns of motion: it reads everything in every step, or is told what has moved and how far at
/// most.
enum class Telling : std::uint8_t { nothing, motion };

/// Whether a recorder keeps the last frames of the scene in memory.
enum class Recorded : std::uint8_t { no, in_memory };

class GrazeContender final : public Contender {
 public:
  GrazeContender(const BenchScene& scene, const World& world, Task task, unsigned threads, Telling telling,
                 InstructionSet set, Recorded recorded);

  void frame() override;
  void collect(Found& found) const override;

  /// After each frame, outside its time: adds its report to the hash. A recorder writes meanwhile, as it does
  /// in the rest of a frame's time in a loop at 60 Hz.
  void note() {
    hash_.add(*report_);
    while (recorder_ && recorder_->statistics().frames + recorder_->statistics().dropped < report_->frame())
      std::this_thread::yield();
  }
  [[nodiscard]] std::uint64_t hash() const { return hash_.value(); }
  [[nodiscard]] const StepStatistics& statistics() const { return report_->statistics(); }

 private:
  [[nodiscard]] std::uint32_t number_of(ObjectId id) const;
  void collect_contacts(const PairReport& pair, Found& found) const;

  const World& world_;
  Task task_;
  Telling telling_;
  InstructionSet set_;
  Scene scene_;
  std::optional<Recorder> recorder_;
  std::vector<ObjectId> ids_;
  std::vector<ObjectId> moved_;
  std::vector<double> displacements_;
  ReportHandle report_;
  scenes::ReportHash hash_;
};

}  // namespace graze::bench
