// Times the steps of seeded scenes on one thread and says what they found:
//   graze_measure [scene [task [frames [instruction set]]]]
// One line for each scene and task: median and 99th percentile of a step in ms of processor time (other load
// on the machine adds little to it), the number of contacts of all frames, a hash of all reports, which two
// builds or machines can compare, and how the last step's questions were decided. An empty argument means
// all.

#include <algorithm>
#include <array>
#include <bit>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <graze/graze.hpp>
#include <graze/instruction_set.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenes.hpp"

namespace graze::bench {
namespace {

struct Task {
  std::string_view name;
  ContactDetail detail;
};
constexpr std::array<Task, 3> tasks{
    {{"A", ContactDetail::vertices}, {"B", ContactDetail::features}, {"D", ContactDetail::none}}};

/// FNV-1a over 64-bit words.
class Hash {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3U; }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const FrameReport& report) {
    for (const PairReport& pair : report.pairs()) {
      add(pair.distance.lower);
      add(pair.distance.upper);
    }
    for (const Contact& contact : report.contacts()) {
      add(std::uint64_t{contact.feature_a.index} << 32U | contact.feature_b.index);
      for (int axis = 0; axis < 3; ++axis) add(contact.point_a[axis]);
      add(contact.distance);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

void measure(const BenchScene& bench, const Task& task, std::size_t frames) {
  SceneSettings settings;
  settings.contact_distance = settings.range = bench.distance;
  settings.detail = task.detail;
  settings.threads = 1;
  Scene scene(settings);
  std::vector<ObjectId> ids;
  for (const Body& body : bench.bodies) ids.push_back(scene.add(body.mesh));
  std::vector<std::vector<Eigen::Vector3f>> positions(ids.size());
  std::vector<double> times;
  std::size_t contacts = 0;
  Hash hash;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      place(bench, bench.bodies[i], frame, positions[i]);
      if (frame == 0) scene.bind_positions(ids[i], positions[i]);
    }
    const std::clock_t start = std::clock();
    const ReportHandle report = scene.step();
    times.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    contacts += report->contacts().size();
    hash.add(*report);
  }
  std::sort(times.begin(), times.end());
  const StepStatistics& last = scene.latest_report()->statistics();
  std::printf("%-8s %s  median %9.3f ms  p99 %9.3f ms  %8zu contacts  hash %016" PRIx64,
              std::string(bench.name).c_str(), std::string(task.name).c_str(), times[times.size() / 2],
              times[times.size() * 99 / 100], contacts, hash.value());
  std::printf("  last: %" PRIu64 " leaf pairs, float discarded %" PRIu64 ", double decided %" PRIu64
              ", exact %" PRIu64 "\n",
              last.leaf_pairs_tested, last.discarded_in_float, last.decided_in_double, last.exact_decisions);
}

}  // namespace
}  // namespace graze::bench

int main(int argc, char** argv) {
  using namespace graze::bench;
  const std::string_view only_scene = argc > 1 ? argv[1] : "";
  const std::string_view only_task = argc > 2 ? argv[2] : "";
  const std::size_t frames = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 0;
  const std::string_view set_name = argc > 4 ? argv[4] : "";
  for (const graze::InstructionSet set : graze::available_instruction_sets())
    if (graze::to_string(set) == set_name) graze::use_instruction_set(set);
  for (const std::string_view name : scene_names()) {
    if (!only_scene.empty() && name != only_scene) continue;
    const BenchScene scene = make_scene(name);
    for (const Task& task : tasks)
      if (only_task.empty() || task.name == only_task)
        measure(scene, task, frames > 0 ? frames : scene.frames);
  }
  return 0;
}
