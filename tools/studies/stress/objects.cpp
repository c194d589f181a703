#include "stress/objects.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "output/text.hpp"
#include "output/text_table.hpp"
#include "stress/scaling.hpp"

namespace graze::tools {
namespace {

// The aims: exponents at which time divided by reading and memory may grow with the number of objects, and
// the speedup of 2 threads over 1.
constexpr double aimed_time_exponent = 0.1;
constexpr double aimed_memory_exponent = 1.05;
constexpr double aimed_speedup = 1.8;

/// The medians of small scenes need more frames.
std::size_t frames_of(std::size_t count, const ObjectsOptions& options) {
  return options.frames > 0 ? options.frames : std::clamp<std::size_t>(100'000 / count, 5, 200);
}

const char* verdict(bool is_met) {
  return is_met ? "met" : "not met";
}

void check_hashes(const std::string& what, const ScalingRun& run, StressResult& result) {
  if (run.hash_one == run.hash_two) return;
  result.violations.push_back(what + ": reports of 1 thread have hash " + hash_text(run.hash_one) +
                              ", those of 2 threads " + hash_text(run.hash_two));
}

nlohmann::ordered_json figures_of(const ScalingRun& run) {
  nlohmann::ordered_json phases;
  for (std::size_t i = 0; i < phase_names.size(); ++i)
    phases[std::string(phase_names[i])] = {run.one.phases_ms[i], run.two.phases_ms[i]};
  return {{"frames", run.frames},
          {"hash", hash_text(run.hash_one)},
          {"pairs_in_contact", run.statistics.pairs_in_contact},
          {"contacts", run.statistics.contacts},
          {"read_ms", run.read_ms},
          {"step_ms", {run.one.wall_ms, run.two.wall_ms}},
          {"step_cpu_ms", {run.one.cpu_ms, run.two.cpu_ms}},
          {"phases_ms", phases},
          {"bytes", run.statistics.bytes.total()},
          {"control_speedup", run.control_speedup},
          {"speedup", run.speedup()},
          {"serial_fraction", run.serial_fraction()},
          {"serial_fraction_by_phases", run.serial_fraction_by_phases()}};
}

void print_growth(const std::vector<double>& counts, const std::vector<double>& times,
                  const std::vector<double>& bytes, StressResult& result) {
  if (counts.size() < 2) return;
  const double time = growth_exponent(counts, times);
  const double memory = growth_exponent(counts, bytes);
  std::printf("growth: time divided by reading ~ n^%.3f (aim %.2f: %s), memory ~ n^%.3f (aim %.2f: %s)\n",
              time, aimed_time_exponent, verdict(time <= aimed_time_exponent), memory, aimed_memory_exponent,
              verdict(memory <= aimed_memory_exponent));
  result.figures["time_exponent"] = time;
  result.figures["memory_exponent"] = memory;
}

void print_phases(const ScalingRun& run) {
  std::vector<std::string> titles = {"ms"};
  titles.insert(titles.end(), phase_names.begin(), phase_names.end());
  const TextTable table = TextTable::of_numbers(titles, 9, 10);
  print("\n" + table.head());
  for (const StepTimes* times : {&run.one, &run.two}) {
    std::vector<std::string> cells = {times == &run.one ? "1 thread" : "2 threads"};
    for (const double ms : times->phases_ms) cells.push_back(fixed(ms, 3));
    print(table.row(cells));
  }
  print("\n");
}

void print_threads(const char* what, const ScalingRun& run) {
  std::printf("\n%s: %.3f ms with 1 thread, %.3f ms with 2: %.2f times as fast (aim %.1f: %s)\n", what,
              run.one.wall_ms, run.two.wall_ms, run.speedup(), aimed_speedup,
              run.is_disturbed() ? "cannot be told" : verdict(run.speedup() >= aimed_speedup));
  std::printf("  processor time of all threads: %.3f and %.3f ms\n", run.one.cpu_ms, run.two.cpu_ms);
  std::printf("  control: arithmetic that shares nothing was %.2f times as fast on 2 threads%s\n",
              run.control_speedup,
              run.is_disturbed() ? "; with so much other load the rest says little of graze" : "");
  print_phases(run);
  for (const auto& [name, fraction] : {std::pair("the step", run.serial_fraction()),
                                       std::pair("its phases", run.serial_fraction_by_phases())})
    std::printf("  serial fraction from %s: %.3f, which lets 16 cores be %.1f times as fast\n", name,
                fraction, predicted_speedup(fraction, 16));
}

}  // namespace

StressResult run_objects_study(const ObjectsOptions& options) {
  StressResult result;
  std::vector<double> counts, times, bytes;
  // Small pairs in plenty, and a scene that still fits in the machine's caches no more.
  constexpr std::size_t many = 10'000;
  ScalingRun of_many;
  std::size_t many_count = 0;
  const TextTable table =
      TextTable::of_numbers({"objects", "frames", "touching pairs", "reading, cpu ms", "step, cpu ms",
                             "/ reading", "memory, MB", "each, kB", "speedup"},
                            8, 7);
  print(table.head());
  for (const std::size_t count : options.counts) {
    DriftingBodies world = DriftingBodies::lattice(count);
    const ScalingRun run = run_scaling(world, frames_of(count, options));
    check_hashes(std::to_string(count) + " objects", run, result);
    print(table.row(
        {std::to_string(count), std::to_string(run.frames), std::to_string(run.statistics.pairs_in_contact),
         fixed(run.read_ms, 3), fixed(run.one.cpu_ms, 3), fixed(run.one.cpu_ms / run.read_ms, 2),
         fixed(static_cast<double>(run.statistics.bytes.total()) / 1e6, 2),
         fixed(static_cast<double>(run.statistics.bytes.total()) / static_cast<double>(count) / 1e3, 3),
         fixed(run.speedup(), 2)}));
    counts.push_back(static_cast<double>(count));
    times.push_back(run.one.cpu_ms / run.read_ms);
    bytes.push_back(static_cast<double>(run.statistics.bytes.total()));
    result.figures["objects"].push_back(figures_of(run));
    result.figures["objects"].back()["count"] = count;
    if (count > many_count && (count <= many || many_count == 0)) {
      many_count = count;
      of_many = run;
    }
  }
  print_growth(counts, times, bytes, result);
  print_threads((std::to_string(many_count) + " objects, many small pairs").c_str(), of_many);

  DriftingBodies pair = DriftingBodies::large_pair();
  const ScalingRun of_pair = run_scaling(pair, options.frames > 0 ? options.frames : 20);
  check_hashes("large pair", of_pair, result);
  print_threads("one pair of 100,000 vertices each", of_pair);
  result.figures["large_pair"] = figures_of(of_pair);
  return result;
}

}  // namespace graze::tools
