#include <string_view>

#include "accuracy/results.hpp"
#include "accuracy/scenes.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

void check_kernels(const KernelStudy& study, const char* input, std::vector<std::string>& violations) {
  for (std::size_t i = 0; i < kernel_count; ++i) {
    const KernelErrors& errors = study.kernels[i];
    const std::string_view name = name_of(static_cast<Kernel>(i));
    if (errors.distance.largest() > distance_bound)
      violations.push_back(format("%s, %s input: a distance is off by %.3g units, more than %g", name.data(),
                                  input, errors.distance.largest(), distance_bound));
    if (errors.wrong_names > 0)
      violations.push_back(
          format("%s, %s input: %llu wrong names", name.data(), input, number(errors.wrong_names)));
  }
  if (study.wrong_pair_rows > 0)
    violations.push_back(format("%s input: %llu pairs whose bounds are not the true distance rounded", input,
                                number(study.wrong_pair_rows)));
}

/// Whether every contact of exact mode must be there: no budget, and not the paper's own test.
bool is_complete(ModeFamily family) {
  return family == ModeFamily::exact || family == ModeFamily::within;
}

void check_mode(const ModeResult& result, std::vector<std::string>& violations) {
  const char* name = result.setting.name.c_str();
  if (result.broken_bounds > 0)
    violations.push_back(
        format("%s: %llu pairs whose bounds do not hold", name, number(result.broken_bounds)));
  if (is_complete(result.setting.family) &&
      (result.contacts_found != result.contacts_true || result.contacts_reported != result.contacts_true ||
       result.pairs_found != result.pairs_true))
    violations.push_back(format("%s: contacts are not those of exact mode", name));
}

}  // namespace

std::vector<std::string> violations_of(const AccuracyResults& results) {
  std::vector<std::string> violations;
  for (const InputKind input : all_input_kinds) {
    const auto index = static_cast<std::size_t>(input);
    check_kernels(results.kernels[index], input_names[index], violations);
  }
  if (results.truth.wrong > 0)
    violations.push_back(format("exact mode on the models: %llu rows or sets that are not the oracle's",
                                number(results.truth.wrong)));
  for (const ModeTable& table : results.modes) {
    for (const ModeResult& result : table.results) check_mode(result, violations);
    for (const ModeResult& result : table.timed) check_mode(result, violations);
  }
  return violations;
}

}  // namespace graze::tools
