#include "bench/tables.hpp"

#include <fstream>
#include <utility>

#include "figures/result_table.hpp"
#include "output/text.hpp"
#include "output/text_table.hpp"

namespace graze::bench {
namespace {

using namespace tools;  // NOLINT: how texts and tables are written

std::string processor_name() {
  std::ifstream stream("/proc/cpuinfo");
  std::string line;
  while (std::getline(stream, line))
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

std::vector<std::string> cells_of(const Timing& timing, double read, double box) {
  if (!timing.complaint.empty()) return {timing.name, "wrong: " + timing.complaint};
  return {timing.name,
          fixed(timing.median, 4),
          fixed(timing.p99, 4),
          fixed(timing.worst, 4),
          fixed(timing.first, 3),
          fixed(timing.median / read, 2),
          fixed(timing.median / box, 2),
          std::to_string(timing.found)};
}

}  // namespace

Surroundings surroundings(const PeerModule& module, std::span<const InstructionSet> sets) {
  std::vector<std::string> names;
  for (const InstructionSet set : sets) names.emplace_back(to_string(set));
  return {processor_name(), GRAZE_BENCH_COMPILER, GRAZE_BENCH_FLAGS, module.compiled_for(), joined(names)};
}

std::string heading(const Surroundings& s) {
  return format(
      "%s; %s; graze: %s, kernels for %s; its peers' code: %s.\n"
      "Times of a frame in ms, with one thread without what other processes took meanwhile.\n",
      s.processor.c_str(), s.compiler.c_str(), s.flags.c_str(), s.instruction_sets.c_str(),
      s.peer_flags.c_str());
}

std::string table_of(const Run& run) {
  std::string text = format("\n%s, task %c, %s: %s%s\n", run.scene.c_str(), static_cast<char>(run.task),
                            counted(run.threads, "thread").c_str(), run.what.c_str(),
                            run.evict ? "; caches evicted before each turn" : "");
  text +=
      format("%zu objects, %zu vertices, distance %g, %zu frames timed, %zu verified; graze's reports %s\n\n",
             run.objects, run.vertices, run.distance, run.frames, run.frames_verified,
             hash_text(run.graze.hash).c_str());
  const TextTable table =
      TextTable::of_numbers({"", "median", "p99", "worst", "first", "/ read", "/ box", "found"}, 21, 10);
  text += table.head();
  for (const Timing& timing : run.timings)
    text += table.row(cells_of(timing, run.median(read_limit), run.median(box_limit)));
  return text;
}

nlohmann::ordered_json figures_of(const Surroundings& s) {
  return {{"processor", s.processor},
          {"compiler", s.compiler},
          {"flags", s.flags},
          {"instruction_sets", s.instruction_sets},
          {"peer_flags", s.peer_flags}};
}

nlohmann::ordered_json figures_of(const Run& run) {
  nlohmann::ordered_json figures = {{"scene", run.scene},
                                    {"what", run.what},
                                    {"task", std::string(1, static_cast<char>(run.task))},
                                    {"threads", run.threads},
                                    {"evict", run.evict},
                                    {"slow", run.slow},
                                    {"frames", run.frames},
                                    {"frames_verified", run.frames_verified},
                                    {"objects", run.objects},
                                    {"vertices", run.vertices},
                                    {"distance", run.distance},
                                    {"near_pairs", run.near_pairs},
                                    {"hash", hash_text(run.graze.hash)},
                                    {"contacts_per_frame", run.graze.contacts_per_frame},
                                    {"object_bytes", run.graze.object_bytes},
                                    {"contenders", nlohmann::ordered_json::array()}};
  for (const Timing& timing : run.timings) {
    nlohmann::ordered_json row = {{"name", timing.name}};
    if (timing.complaint.empty())
      row.update({{"median_ms", timing.median},
                  {"p99_ms", timing.p99},
                  {"worst_ms", timing.worst},
                  {"first_ms", timing.first},
                  {"found", timing.found}});
    else
      row["wrong"] = timing.complaint;
    figures["contenders"].push_back(std::move(row));
  }
  return figures;
}

std::string csv_of(const std::vector<Run>& runs) {
  ResultTable table{"runs", "Runs",
                    columns_of({"scene", "task", "threads", "evict", "slow", "contender", "median_ms",
                                "p99_ms", "worst_ms", "first_ms", "found", "is_right"})};
  for (const Run& run : runs)
    for (const Timing& timing : run.timings) {
      std::vector<Cell> row = {run.scene,
                               std::string(1, static_cast<char>(run.task)),
                               std::uint64_t{run.threads},
                               std::uint64_t{run.evict},
                               run.slow,
                               timing.name};
      if (timing.complaint.empty())
        row.insert(row.end(), {timing.median, timing.p99, timing.worst, timing.first, timing.found});
      else
        row.insert(row.end(), 5, std::string());
      row.emplace_back(std::uint64_t{timing.complaint.empty()});
      table.rows.push_back(std::move(row));
    }
  return csv_of(table);
}

}  // namespace graze::bench
