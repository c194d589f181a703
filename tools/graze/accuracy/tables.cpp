#include "accuracy/tables.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "core/pair/pair_counters.hpp"
#include "text_format.hpp"

namespace graze::tools {
namespace {

std::string row(std::initializer_list<std::string> cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

/// The first column is text, the others numbers.
std::string head(std::initializer_list<std::string> names) {
  std::string line = row(names) + "| :-- |";
  for (std::size_t i = 1; i < names.size(); ++i) line += " --: |";
  return line + "\n";
}

std::string count_text(std::uint64_t value) {
  return format("%llu", static_cast<unsigned long long>(value));
}

/// Rounded so that only all is 100 % and only nothing 0 %.
std::string share_text(double share) {
  if (share == 1) return "100 %";
  if (share == 0) return "0 %";
  const double percent = std::min(99.99, std::max(0.01, 100 * share));
  return format("%.2f %%", percent);
}

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 1 : static_cast<double>(part) / static_cast<double>(whole);
}

template <typename RowOf>
std::string rows_of(const KernelStudy& study, const RowOf& row_of) {
  std::string lines;
  for (std::size_t i = 0; i < kernel_count; ++i)
    lines += row_of(std::string(name_of(static_cast<Kernel>(i))), study.kernels[i]);
  return lines + "\n";
}

std::string work_text(const ModeResult& result, std::uint32_t frames) {
  return format("%.0f", static_cast<double>(result.region_pairs) / frames);
}

}  // namespace

std::string number_text(double value) {
  return value == 0 ? "0" : format("%.3g", value);
}

std::string kernel_distance_table(const KernelStudy& study) {
  return head({"kernel", "contacts", "wrong names", "largest", "mean", "largest, absolute",
               "largest, relative"}) +
         rows_of(study, [](const std::string& name, const KernelErrors& errors) {
           return row({name, count_text(errors.contacts), count_text(errors.wrong_names),
                       format("%.2f", errors.distance.largest()), format("%.3f", errors.distance.mean()),
                       number_text(errors.distance_absolute.largest()),
                       number_text(errors.distance_relative.largest())});
         });
}

std::string kernel_point_table(const KernelStudy& study) {
  return head({"kernel", "points, largest", "points, mean", "apart, largest", "normal, largest angle",
               "normal, mean angle", "normal, length − 1"}) +
         rows_of(study, [](const std::string& name, const KernelErrors& errors) {
           return row({name, number_text(errors.point.largest()), number_text(errors.point.mean()),
                       number_text(errors.apart.largest()), number_text(errors.normal_angle.largest()),
                       number_text(errors.normal_angle.mean()), number_text(errors.normal_length.largest())});
         });
}

std::string decision_table(const AccuracyResults& results) {
  static constexpr std::array<const char*, 3> names = {"random", "nearly degenerate", "degenerate"};
  std::string text = head({"input", "scenes", "pairs", "wrong bounds", "discarded in float", "named in float",
                           "decided in double", "exact decisions", "exact, of those"});
  for (std::size_t i = 0; i < names.size(); ++i) {
    const KernelStudy& study = results.kernels[i];
    const PairCounters& counters = study.counters;
    text += row(
        {names[i], count_text(study.scenes), count_text(study.pair_rows), count_text(study.wrong_pair_rows),
         count_text(counters.discarded_in_float), count_text(counters.named_in_float),
         count_text(counters.decided_in_double), count_text(counters.exact_decisions),
         share_text(share(counters.exact_decisions,
                          counters.named_in_float + counters.decided_in_double + counters.exact_decisions))});
  }
  return text + "\n";
}

std::string mode_table(const std::vector<ModeResult>& results, std::uint32_t frames) {
  std::string text =
      head({"setting", "complete", "found", "right", "touching found", "width, largest", "width, mean",
            "above truth, mean", "below truth, mean", "broken bounds", "region pairs"});
  for (const ModeResult& result : results) {
    const bool has_contacts = result.setting.settings.detail != ContactDetail::none;
    text +=
        row({result.setting.name, share_text(share(result.complete_rows, result.pair_rows)),
             has_contacts ? share_text(result.recall()) : "–",
             has_contacts ? share_text(result.precision()) : "–",
             share_text(share(result.pairs_found, result.pairs_true)), number_text(result.width.largest()),
             number_text(result.width.mean()), number_text(result.above.mean()),
             number_text(result.below.mean()), count_text(result.broken_bounds), work_text(result, frames)});
  }
  return text + "\n";
}

std::string time_table(const ModeTable& table) {
  const double exact_ms = table.results.front().step_ms;
  std::string text = head({"setting", "ms a step", "of exact mode"});
  for (const auto* results : {&table.results, &table.timed})
    for (const ModeResult& result : *results)
      text += row({result.setting.name, number_text(result.step_ms),
                   format("%.0f %%", 100 * result.step_ms / exact_ms)});
  return text + "\n";
}

}  // namespace graze::tools
