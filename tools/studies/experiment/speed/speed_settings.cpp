#include "experiment/speed/speed_settings.hpp"

#include <chrono>
#include <cmath>

#include "output/text.hpp"

namespace graze::tools {
namespace {

SceneSettings settings_of(SpeedQuestion question, double contact_distance) {
  SceneSettings settings = exact_settings(ContactDetail::vertices, contact_distance);
  if (question == SpeedQuestion::contacts) settings.range = contact_distance;
  return settings;
}

ModeSetting within(std::string name, double tolerance, const SceneSettings& settings) {
  ModeSetting setting{std::move(name), ModeFamily::within, settings};
  setting.settings.accuracy = Accuracy::within(tolerance);
  return setting;
}

/// Each level's number is `part` of the most that eq. 6 gives at rest. The last, which decides what is
/// reported, is `last_part` of the contact distance.
ModeSetting paper(const MovingSurfaces& scene, double part, double last_part, const SceneSettings& settings) {
  std::vector<double> epsilon;
  for (std::size_t level = 1; level < scene.level_epsilon().size(); ++level)
    epsilon.push_back(part * scene.level_epsilon()[level]);
  epsilon.push_back(last_part * settings.contact_distance);
  const bool is_loose = last_part != 1;
  ModeSetting setting{format("numbers × %g", part) + (is_loose ? format(", the last × %g", last_part) : ""),
                      is_loose ? ModeFamily::paper_loose : ModeFamily::paper_numbers, settings};
  setting.settings.accuracy = Accuracy::paper(epsilon);
  return setting;
}

void add_tolerances(const MovingSurfaces& scene, const SceneSettings& settings,
                    std::vector<ModeSetting>& all) {
  for (const double edges : {0.01, 0.1, 0.3, 1.0, 3.0, 10.0})
    all.push_back(within(format("within(%g edges)", edges), edges * scene.mean_edge_length(), settings));
  for (std::size_t level = 1; level < scene.level_epsilon().size(); ++level)
    all.push_back(within(format("within(level %zu)", level), scene.level_epsilon()[level], settings));
}

/// Work budgets, as parts of the most work that a step of exact mode takes.
constexpr double budget_parts[] = {1.0, 0.75, 0.5, 0.25, 0.125, 0.03125, 0.0};

}  // namespace

ModeSetting exact_speed_setting(SpeedQuestion question, double contact_distance) {
  return {"exact", ModeFamily::exact, settings_of(question, contact_distance)};
}

std::vector<ModeSetting> speed_settings(const MovingSurfaces& scene, SpeedQuestion question,
                                        double contact_distance, std::uint64_t exact_work) {
  const SceneSettings settings = settings_of(question, contact_distance);
  std::vector<ModeSetting> all;
  if (question == SpeedQuestion::contacts) {
    all.push_back(within("within(1 edge)", scene.mean_edge_length(), settings));
  } else {
    add_tolerances(scene, settings, all);
  }
  all.push_back({"paper, eq. 3 and 6", ModeFamily::paper_formula, settings});
  all.back().settings.accuracy = Accuracy::paper();
  for (const double part : {1.0, 0.85, 0.7, 0.6, 0.5, 0.35, 0.25, 0.15})
    all.push_back(paper(scene, part, 1, settings));
  all.push_back(paper(scene, 0.5, 1.5, settings));
  for (const double part : budget_parts) {
    all.push_back({format("work budget × %g", part), ModeFamily::work_budget, settings});
    all.back().settings.work_budget =
        static_cast<std::uint64_t>(std::llround(part * static_cast<double>(exact_work)));
  }
  return all;
}

std::vector<ModeSetting> timed_speed_settings(SpeedQuestion question, double contact_distance,
                                              double exact_ms) {
  std::vector<ModeSetting> all;
  for (const double part : budget_parts) {
    all.push_back(
        {format("time budget × %g", part), ModeFamily::time_budget, settings_of(question, contact_distance)});
    all.back().settings.time_budget = std::chrono::microseconds(std::llround(part * exact_ms * 1000));
  }
  return all;
}

}  // namespace graze::tools
