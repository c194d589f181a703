#include "experiment/paper/played_setting.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "output/text.hpp"

namespace graze::tools {
namespace {

constexpr double everything = std::numeric_limits<double>::infinity();

SceneSettings settings_of(ContactDetail detail, double contact_distance, double range) {
  SceneSettings settings;
  settings.contact_distance = contact_distance;
  settings.range = range;
  settings.detail = detail;
  settings.threads = 1;
  return settings;
}

}  // namespace

PlayedSetting setting_of(const PaperRow& row) {
  PlayedSetting setting{row.name, settings_of(ContactDetail::regions, row.last(), everything), row.rules};
  setting.settings.accuracy = Accuracy::paper(row.rules[0].epsilon);
  return setting;
}

PlayedSetting formula_setting(double contact_distance) {
  PlayedSetting setting{"eq. 3 and 6", settings_of(ContactDetail::regions, contact_distance, everything), {}};
  setting.settings.accuracy = Accuracy::paper();
  return setting;
}

PlayedSetting exact_setting(ContactDetail detail, double contact_distance, double range) {
  return {range == 0 ? "exact" : "exact, all distances", settings_of(detail, contact_distance, range), {}};
}

PlayedSetting within_setting(ContactDetail detail, double contact_distance, double tolerance) {
  PlayedSetting setting{
      format("within(%g), all distances", tolerance), settings_of(detail, contact_distance, everything), {}};
  setting.settings.accuracy = Accuracy::within(tolerance);
  return setting;
}

PlayedMotion::PlayedMotion(const RecordedMotion& motion, const PlayedSetting& setting)
    : motion_(motion), scene_(setting.settings) {
  for (const RowRule& rule : setting.rules)
    scene_.set_rule(rule.kinds[0], rule.kinds[1],
                    {rule.epsilon.back(), setting.settings.range, rule.epsilon});
  for (const RecordedObject& object : motion.objects) {
    ObjectSettings settings;
    settings.name = object.name;
    settings.kind = object.kind_id;
    settings.group = object.group;
    ids_.push_back(scene_.add(object.mesh, settings));
  }
}

ReportHandle PlayedMotion::step(std::size_t frame) {
  for (std::size_t i = 0; i < ids_.size(); ++i)
    scene_.set_positions(ids_[i], motion_.objects[i].positions(frame));
  const auto start = std::chrono::steady_clock::now();
  ReportHandle report = scene_.step();
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  step_ms_ = elapsed.count();
  return report;
}

const PairReport* PlayedMotion::row(const FrameReport& report, std::size_t a, std::size_t b) const {
  const auto found = std::ranges::find_if(
      report.pairs(), [&](const PairReport& row) { return row.a == ids_[a] && row.b == ids_[b]; });
  return found == report.pairs().end() ? nullptr : &*found;
}

std::vector<double> step_times(const RecordedMotion& motion, const PlayedSetting& setting,
                               std::uint32_t runs) {
  std::vector<double> fastest(motion.frame_count(), std::numeric_limits<double>::infinity());
  for (std::uint32_t run = 0; run < std::max(1U, runs); ++run) {
    PlayedMotion scene(motion, setting);
    for (std::size_t frame = 0; frame < fastest.size(); ++frame) {
      scene.step(frame);
      fastest[frame] = std::min(fastest[frame], scene.step_ms());
    }
  }
  return fastest;
}

}  // namespace graze::tools
