#include "accuracy/tables.hpp"

#include <algorithm>

#include "accuracy/scenes.hpp"
#include "accuracy/tally.hpp"
#include "core/pair/pair_counters.hpp"
#include "output/text.hpp"
#include "output/text_table.hpp"

namespace graze::tools {
namespace {

/// Rounded so that only all is 100 % and only nothing 0 %.
std::string share_text(double share) {
  if (share == 1) return "100 %";
  if (share == 0) return "0 %";
  const double percent = std::min(99.99, std::max(0.01, 100 * share));
  return fixed(percent, 2) + " %";
}

/// A row for each kernel.
template <typename CellsOf>
std::string kernel_table(const KernelStudy& study, const std::vector<std::string>& titles,
                         const CellsOf& cells_of) {
  const TextTable table = TextTable::of_numbers(titles);
  std::string text = table.head();
  for (std::size_t i = 0; i < kernel_count; ++i)
    text += table.row(cells_of(std::string(name_of(static_cast<Kernel>(i))), study.kernels[i]));
  return text + "\n";
}

}  // namespace

std::string kernel_distance_table(const KernelStudy& study) {
  return kernel_table(
      study,
      {"kernel", "contacts", "wrong names", "largest", "mean", "largest, absolute", "largest, relative"},
      [](const std::string& name, const KernelErrors& errors) -> std::vector<std::string> {
        return {name,
                std::to_string(errors.contacts),
                std::to_string(errors.wrong_names),
                fixed(errors.distance.largest(), 2),
                fixed(errors.distance.mean(), 3),
                rounded(errors.distance_absolute.largest(), 3),
                rounded(errors.distance_relative.largest(), 3)};
      });
}

std::string kernel_point_table(const KernelStudy& study) {
  return kernel_table(study,
                      {"kernel", "points, largest", "points, mean", "apart, largest", "normal, largest angle",
                       "normal, mean angle", "normal, length − 1"},
                      [](const std::string& name, const KernelErrors& errors) -> std::vector<std::string> {
                        return {name,
                                rounded(errors.point.largest(), 3),
                                rounded(errors.point.mean(), 3),
                                rounded(errors.apart.largest(), 3),
                                rounded(errors.normal_angle.largest(), 3),
                                rounded(errors.normal_angle.mean(), 3),
                                rounded(errors.normal_length.largest(), 3)};
                      });
}

std::string decision_table(const AccuracyResults& results) {
  const TextTable table =
      TextTable::of_numbers({"input", "scenes", "pairs", "wrong bounds", "discarded in float",
                             "named in float", "decided in double", "exact decisions", "exact, of those"});
  std::string text = table.head();
  for (std::size_t i = 0; i < input_names.size(); ++i) {
    const KernelStudy& study = results.kernels[i];
    const PairCounters& counters = study.counters;
    const double exact_share =
        share(counters.exact_decisions,
              counters.named_in_float + counters.decided_in_double + counters.exact_decisions);
    text += table.row({input_names[i], std::to_string(study.scenes), std::to_string(study.pair_rows),
                       std::to_string(study.wrong_pair_rows), std::to_string(counters.discarded_in_float),
                       std::to_string(counters.named_in_float), std::to_string(counters.decided_in_double),
                       std::to_string(counters.exact_decisions), share_text(exact_share)});
  }
  return text + "\n";
}

std::string mode_table(const std::vector<ModeResult>& results, std::uint32_t frames) {
  const TextTable table = TextTable::of_numbers({"setting", "complete", "found", "right", "touching found",
                                                 "width, largest", "width, mean", "above truth, mean",
                                                 "below truth, mean", "broken bounds", "region pairs"});
  std::string text = table.head();
  for (const ModeResult& result : results) {
    const bool has_contacts = result.setting.settings.detail != ContactDetail::none;
    text += table.row(
        {result.setting.name, share_text(share(result.complete_rows, result.pair_rows)),
         has_contacts ? share_text(result.recall()) : "–",
         has_contacts ? share_text(result.precision()) : "–",
         share_text(share(result.pairs_found, result.pairs_true)), rounded(result.width.largest(), 3),
         rounded(result.width.mean(), 3), rounded(result.above.mean(), 3), rounded(result.below.mean(), 3),
         std::to_string(result.broken_bounds), fixed(static_cast<double>(result.region_pairs) / frames, 0)});
  }
  return text + "\n";
}

std::string time_table(const ModeTable& modes) {
  const double exact_ms = modes.results.front().step_ms;
  const TextTable table = TextTable::of_numbers({"setting", "ms a step", "of exact mode"});
  std::string text = table.head();
  for (const auto* results : {&modes.results, &modes.timed})
    for (const ModeResult& result : *results)
      text += table.row({result.setting.name, rounded(result.step_ms, 3),
                         fixed(100 * result.step_ms / exact_ms, 0) + " %"});
  return text + "\n";
}

}  // namespace graze::tools
