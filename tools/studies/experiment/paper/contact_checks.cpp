#include "experiment/paper/contact_checks.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace graze::tools {
namespace {

using VertexName = std::array<std::uint32_t, 2>;

constexpr std::array<double, 2> tolerances = {0.5, 5};

std::vector<VertexName> vertex_names_of(std::span<const Contact> contacts) {
  std::vector<VertexName> names;
  for (const Contact& contact : contacts) names.push_back({contact.feature_a.index, contact.feature_b.index});
  return names;
}

/// The closest vertices of each pair of leaves that has any below the distance.
std::vector<VertexName> leaf_contacts(PaperWalk& walk, double distance) {
  std::vector<VertexName> names;
  for (const std::uint32_t number : walk.near_leaves(distance)) {
    const VertexPair& nearest = walk.leaves(number).nearest;
    names.push_back({nearest.a, nearest.b});
  }
  std::ranges::sort(names);
  return names;
}

std::vector<VertexName> vertex_contacts(PaperWalk& walk, double distance) {
  std::vector<VertexName> names;
  for (const VertexPair& pair : walk.near_vertices(distance)) names.push_back({pair.a, pair.b});
  return names;
}

/// The true distance is the root of a sum that double holds exactly: it lies between the doubles about it.
void check_distance(const PairReport& row, double squared, double tolerance, ContactCheck& check) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double root = std::sqrt(squared);
  const double width = row.distance.upper - row.distance.lower;
  const bool holds =
      row.distance.lower <= std::nextafter(root, infinity) && row.distance.upper >= std::nextafter(root, 0) &&
      width <= tolerance + 4 * (std::nextafter(row.distance.upper, infinity) - row.distance.upper);
  ++check.distances;
  check.distances_wrong += holds ? 0U : 1U;
  check.widest = std::max(check.widest, width);
}

}  // namespace

void count_work(const StepStatistics& statistics, ContactCheck& check) {
  check.leaf_pairs += statistics.work.leaf_pairs_tested;
  for (std::size_t level = 0; level < check.expanded.size(); ++level)
    check.expanded[level] += statistics.work.regions_expanded[level];
}

ContactChecks::ContactChecks(const RecordedMotion& motion, const std::set<double>& distances) {
  constexpr double everything = std::numeric_limits<double>::infinity();
  const double largest = *distances.rbegin();
  for (const double distance : distances) add(motion, exact_setting(ContactDetail::regions, distance, 0));
  add(motion, exact_setting(ContactDetail::regions, largest, everything));
  add(motion, exact_setting(ContactDetail::vertices, largest, everything));
  for (const double tolerance : tolerances) {
    add(motion, within_setting(ContactDetail::regions, largest, tolerance));
    add(motion, within_setting(ContactDetail::vertices, largest, tolerance));
  }
}

void ContactChecks::add(const RecordedMotion& motion, const PlayedSetting& setting) {
  ContactCheck check;
  check.name = setting.name;
  check.detail = setting.settings.detail;
  check.contact_distance = setting.settings.contact_distance;
  Checked& checked = checked_.emplace_back();
  checked.setting = setting;
  checked.result = check;
  checked.scene = std::make_unique<PlayedMotion>(motion, setting);
}

void ContactChecks::step(std::size_t frame) {
  for (Checked& checked : checked_) {
    checked.report = checked.scene->step(frame);
    count_work(checked.report->statistics(), checked.result);
  }
}

void ContactChecks::check(PaperWalk& walk, std::size_t a, std::size_t b) {
  const double nearest = walk.nearest_vertices().squared;
  for (Checked& checked : checked_) {
    const SceneSettings& settings = checked.setting.settings;
    const PairReport* row = checked.scene->row(*checked.report, a, b);
    const auto truth = settings.detail == ContactDetail::regions
                           ? leaf_contacts(walk, settings.contact_distance)
                           : vertex_contacts(walk, settings.contact_distance);
    const auto reported =
        row == nullptr ? std::vector<VertexName>() : vertex_names_of(checked.report->contacts(*row));
    tally_contacts(truth, reported, checked.result);
    if (row != nullptr) check_distance(*row, nearest, settings.accuracy.tolerance(), checked.result);
  }
}

std::vector<ContactCheck> ContactChecks::results() const {
  std::vector<ContactCheck> results;
  for (const Checked& checked : checked_) results.push_back(checked.result);
  return results;
}

std::vector<PlayedSetting> ContactChecks::settings() const {
  std::vector<PlayedSetting> settings;
  for (const Checked& checked : checked_) settings.push_back(checked.setting);
  return settings;
}

}  // namespace graze::tools
