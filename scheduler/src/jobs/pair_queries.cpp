#include "jobs/pair_queries.hpp"

#include <algorithm>
#include <limits>

#include "objects/leaf_test_slack.hpp"

namespace graze {
namespace {

/// The largest number of leaf pairs in the fronts of all pairs of objects together. Each takes 16 bytes.
constexpr std::size_t front_pairs_of_all = std::size_t{1} << 22;

/// How far two surfaces moved in this step, as an estimate of the next step's motion. A surface whose version
/// is the answered one did not move in this step, so its last displacement does not count. Neither does the
/// first placement of a surface.
double motion_of(const PairJob& job) {
  constexpr std::uint64_t placed_once = 1;
  const auto of = [](const Surface& surface, std::uint64_t answered) {
    const bool has_come = surface.version() > placed_once && surface.version() != answered;
    return has_come ? surface.displacement() : 0;
  };
  return of(job.a->surface(), job.memory->version_a) + of(job.b->surface(), job.memory->version_b);
}

double smaller_leaf_of(const PairJob& job) {
  return std::min(job.a->surface().leaf_size(), job.b->surface().leaf_size());
}

/// The slack of a front: it lasts for some steps of the last motion, but lists few leaf pairs that are not
/// near.
double slack_of(double motion, double leaf) {
  constexpr double steps = 6;
  constexpr double least_leaf_sizes = 1.0 / 64;
  constexpr double most_leaf_sizes = 0.5;
  if (motion > most_leaf_sizes * leaf) return 0;
  return std::clamp(steps * motion, least_leaf_sizes * leaf, most_leaf_sizes * leaf);
}

/// Whether a limit may leave out contacts of a job's pair in this step.
bool may_be_cut(const PairJob& job, std::size_t limit) {
  return limit > 0 && (job.last == nullptr || job.last->contacts_cut || job.last->contact_count > limit / 2);
}

/// Makes the filter of an object with itself, of the groups of its faces and of its neighbourhoods.
FeatureFilter filter_of_self(const PairJob& job, ContactDetail detail) {
  const FeatureFilter all(job.a->face_groups.get(), job.b->face_groups.get());
  const FeatureFilter& groups = job.groups.filter == nullptr ? all : *job.groups.filter;
  const double rest_distance = job.a->settings.self_at_rest ? 0 : job.thresholds.threshold;
  return {groups, SelfQuery{job.a->self.get(), rest_distance, is_about_vertices(detail)}};
}

/// Returns what says which features of a pair are looked at, or null if all are, or none. It may be in
/// `room`.
const FeatureFilter* filter_of(const PairJob& job, ContactDetail detail, std::optional<FeatureFilter>& room) {
  if (!job.is_of_self()) return groups_of(job, room);
  return &room.emplace(filter_of_self(job, detail));
}

}  // namespace

const FeatureFilter* groups_of(const PairJob& job, std::optional<FeatureFilter>& room) {
  room.reset();
  if (job.groups.version != 0) return job.groups.filter;
  if (!job.a->hides_some_faces() && !job.b->hides_some_faces()) return nullptr;
  room.emplace(job.a->face_groups.get(), job.b->face_groups.get());
  return room->leaves_some() ? &*room : nullptr;
}

PairQuery PairQueries::of(const PairJob& job, std::optional<FeatureFilter>& filter) const {
  PairQuery query;
  query.detail = settings_.detail;
  query.mode = settings_.accuracy.mode();
  query.tolerance = settings_.accuracy.tolerance();
  query.epsilon = job.thresholds.epsilon;
  query.threshold = job.thresholds.threshold;
  query.reach =
      job.was_in_contact() || job.met_on_way ? std::numeric_limits<double>::infinity() : job.thresholds.reach;
  query.region_distance_reach = job.thresholds.reach;
  query.groups = filter_of(job, query.detail, filter);
  set_limits(query);
  set_slacks(query, job);
  set_solids(query, job);
  if (job.task == PairJob::Task::end) {
    query.threshold = 0;
    if (!is_about_vertices(query.detail)) query.detail = ContactDetail::none;
  }
  return query;
}

/// Sets what is the pair's share of something that all pairs have together, and how many contacts it keeps.
void PairQueries::set_limits(PairQuery& query) const {
  query.region_distance_limit = settings_.region_distances == 0
                                    ? 0
                                    : std::max<std::size_t>(1, settings_.region_distances / pair_count_);
  query.front_limit = front_pairs_of_all / pair_count_;
  query.contact_limit = contacts_.of_search();
}

void PairQueries::set_slacks(PairQuery& query, const PairJob& job) {
  const double motion = motion_of(job);
  const double leaf = smaller_leaf_of(job);
  query.slack = slack_of(motion, leaf);
  query.leaf_test_slack = leaf_test_slack.of(motion, leaf);
  // A list of features only helps if all of them may become contacts. It is made no longer than necessary.
  if (may_be_cut(job, query.contact_limit)) return;
  query.list_slack =
      (is_about_vertices(query.detail) ? list_slack_of_vertices : list_slack_of_features).of(motion, leaf);
}

void PairQueries::set_solids(PairQuery& query, const PairJob& job) const {
  if (is_about_vertices(query.detail) || job.task != PairJob::Task::detect || job.is_of_self()) return;
  query.a_is_solid = job.a->settings.solid;
  query.b_is_solid = job.b->settings.solid;
  query.wants_way_out = settings_.ways_out && query.mode != AccuracyMode::paper;
}

}  // namespace graze
