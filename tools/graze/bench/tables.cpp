#include "bench/tables.hpp"

#include <cinttypes>
#include <fstream>

#include "text_format.hpp"

namespace graze::bench {
namespace {

using tools::format;

std::string processor_name() {
  std::ifstream stream("/proc/cpuinfo");
  std::string line;
  while (std::getline(stream, line))
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

const char* plural(std::size_t count) {
  return count == 1 ? "" : "s";
}

std::string row_of(const Timing& timing, double read, double box) {
  if (!timing.complaint.empty())
    return format("| %-21s | wrong: %s |\n", timing.name.c_str(), timing.complaint.c_str());
  return format("| %-21s | %10.4f | %10.4f | %10.4f | %10.3f | %8.2f | %8.2f | %8zu |\n", timing.name.c_str(),
                timing.median, timing.p99, timing.worst, timing.first, timing.median / read,
                timing.median / box, timing.found);
}

}  // namespace

Surroundings surroundings(const PeerModule& module, std::span<const InstructionSet> sets) {
  std::string names;
  for (const InstructionSet set : sets) names += (names.empty() ? "" : ", ") + std::string(to_string(set));
  return {processor_name(), GRAZE_BENCH_COMPILER, GRAZE_BENCH_FLAGS, module.compiled_for(), names};
}

std::string heading(const Surroundings& s) {
  return format(
      "%s; %s; graze: %s, kernels for %s; its peers' code: %s.\n"
      "Times of a frame in ms, with one thread without what other processes took meanwhile.\n",
      s.processor.c_str(), s.compiler.c_str(), s.flags.c_str(), s.instruction_sets.c_str(),
      s.peer_flags.c_str());
}

std::string table_of(const Run& run) {
  std::string text = format("\n%s, task %c, %u thread%s: %s%s\n", run.scene.c_str(),
                            static_cast<char>(run.task), run.threads, plural(run.threads), run.what.c_str(),
                            run.evict ? "; caches evicted before each turn" : "");
  text += format(
      "%zu objects, %zu vertices, distance %g, %zu frames timed, %zu verified; graze's reports %016" PRIx64
      "\n\n",
      run.objects, run.vertices, run.distance, run.frames, run.frames_verified, run.graze.hash);
  text += format("| %-21s | %10s | %10s | %10s | %10s | %8s | %8s | %8s |\n", "", "median", "p99", "worst",
                 "first", "/ read", "/ box", "found");
  text += "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Timing& timing : run.timings)
    text += row_of(timing, run.median(read_limit), run.median(box_limit));
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
                                    {"hash", format("%016" PRIx64, run.graze.hash)},
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
  std::string text =
      "scene,task,threads,evict,slow,contender,median_ms,p99_ms,worst_ms,first_ms,found,is_right\n";
  for (const Run& run : runs)
    for (const Timing& timing : run.timings) {
      text += format("%s,%c,%u,%d,%zu,\"%s\",", run.scene.c_str(), static_cast<char>(run.task), run.threads,
                     run.evict ? 1 : 0, run.slow, timing.name.c_str());
      text += timing.complaint.empty() ? format("%.6g,%.6g,%.6g,%.6g,%zu,1\n", timing.median, timing.p99,
                                                timing.worst, timing.first, timing.found)
                                       : ",,,,,0\n";
    }
  return text;
}

}  // namespace graze::bench
