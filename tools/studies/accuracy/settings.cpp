#include "accuracy/settings.hpp"

#include <chrono>
#include <cmath>
#include <limits>

#include "output/text.hpp"

namespace graze::tools {
namespace {

ModeSetting exact_mode(ContactDetail detail, double contact_distance) {
  return {"exact", ModeFamily::exact, exact_settings(detail, contact_distance)};
}

/// Each level's number is `part` of the most that eq. 6 gives for the models at rest.
ModeSetting paper_mode(const MovingSurfaces& models, ContactDetail detail, double contact_distance,
                       double part, double last_part) {
  std::vector<double> epsilon;
  for (std::size_t level = 1; level < models.level_epsilon().size(); ++level)
    epsilon.push_back(part * models.level_epsilon()[level]);
  epsilon.push_back(last_part * contact_distance);
  ModeSetting setting{format("paper, numbers of eq. 6 × %g", part), ModeFamily::paper_numbers,
                      exact_settings(detail, contact_distance)};
  if (last_part != 1) {
    setting.family = ModeFamily::paper_loose;
    setting.name += format(", the last × %g", last_part);
  }
  setting.settings.accuracy = Accuracy::paper(epsilon);
  return setting;
}

}  // namespace

std::string title_of(ModeFamily family) {
  switch (family) {
    case ModeFamily::exact:
      return "exact";
    case ModeFamily::within:
      return "within(t)";
    case ModeFamily::work_budget:
      return "work budget";
    case ModeFamily::time_budget:
      return "time budget";
    case ModeFamily::paper_formula:
      return "paper, eq. 3 and 6";
    case ModeFamily::paper_numbers:
      return "paper, numbers";
    default:
      return "paper, last number too large";
  }
}

SceneSettings exact_settings(ContactDetail detail, double contact_distance) {
  SceneSettings settings;
  settings.contact_distance = contact_distance;
  settings.range = std::numeric_limits<double>::infinity();
  settings.detail = detail;
  settings.threads = 1;
  return settings;
}

std::vector<ModeSetting> surface_settings(const MovingSurfaces& models, ContactDetail detail,
                                          double contact_distance, std::uint64_t exact_work) {
  std::vector<ModeSetting> settings = {exact_mode(detail, contact_distance)};
  for (const double edges : {0.001, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0}) {
    ModeSetting setting{format("within(%g edges)", edges), ModeFamily::within,
                        exact_settings(detail, contact_distance)};
    setting.settings.accuracy = Accuracy::within(edges * models.mean_edge_length());
    settings.push_back(setting);
  }
  for (const double part : {1.0, 0.5, 0.25, 0.125, 0.03125, 0.0}) {
    const auto budget = static_cast<std::uint64_t>(part * static_cast<double>(exact_work));
    ModeSetting setting{"work budget of " + std::to_string(budget), ModeFamily::work_budget,
                        exact_settings(detail, contact_distance)};
    setting.settings.work_budget = budget;
    settings.push_back(setting);
  }
  return settings;
}

std::vector<ModeSetting> vertex_settings(const MovingSurfaces& models, ContactDetail detail,
                                         double contact_distance) {
  std::vector<ModeSetting> settings = {exact_mode(detail, contact_distance)};
  ModeSetting formula{"paper, eq. 3 and 6", ModeFamily::paper_formula,
                      exact_settings(detail, contact_distance)};
  formula.settings.accuracy = Accuracy::paper();
  settings.push_back(formula);
  for (const double part : {1.0, 0.7, 0.5, 0.35, 0.25, 0.15})
    settings.push_back(paper_mode(models, detail, contact_distance, part, 1));
  settings.push_back(paper_mode(models, detail, contact_distance, 0.5, 1.5));
  return settings;
}

std::vector<ModeSetting> timed_settings(ContactDetail detail, double contact_distance, double exact_ms) {
  std::vector<ModeSetting> settings;
  for (const double part : {1.0, 0.5, 0.25, 0.125, 0.03125, 0.0}) {
    const auto budget = static_cast<std::int64_t>(std::llround(part * exact_ms * 1000));
    ModeSetting setting{"time budget of " + std::to_string(budget) + " µs", ModeFamily::time_budget,
                        exact_settings(detail, contact_distance)};
    setting.settings.time_budget = std::chrono::microseconds(budget);
    settings.push_back(setting);
  }
  return settings;
}

}  // namespace graze::tools
