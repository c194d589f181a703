#include "core/pair/carrying.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pair/contact_rank.hpp"

namespace graze {
namespace {

/// A contact that was listed leads while it is at most this part of the band less deep than the deepest.
constexpr double part_to_lead = 1.0 / 4;

/// Contacts that differ by at most this part of the band are equally deep. The outermost of these leads.
constexpr double part_of_even = 1.0 / 64;

/// The cosine of 26°: pushes that differ by more do not carry together.
constexpr double least_cosine = 0.898794;

/// This many contacts push as the first leader does. Other directions get half of the remaining places.
constexpr std::size_t least_of_first = 4;

/// A contact that was listed is taken if it gains this part of what the best one gains.
constexpr double part_to_stay = 3.0 / 5;

/// A contact stands on those chosen if it is outside their outline by less than this part of its extent.
constexpr double part_of_extent = 1.0 / 16;

/// A point that is this near to the line of an edge, as an angle, is on the edge.
constexpr double least_sine = 1e-9;

bool comes_before(const Contact& left, const Contact& right) {
  return contact_order(left) < contact_order(right);
}

Eigen::Vector3d middle_of(const Contact& contact) {
  return (contact.point_a + contact.point_b) / 2;
}

bool share_vertex(const Contact& left, const Contact& right) {
  const auto is_vertex = [](const Feature& feature) { return feature.kind == FeatureKind::vertex; };
  return (is_vertex(left.feature_a) && left.feature_a == right.feature_a) ||
         (is_vertex(left.feature_b) && left.feature_b == right.feature_b);
}

template <typename Vector>
double cross(const Vector& left, const Vector& right) {
  return left.x() * right.y() - left.y() * right.x();
}

template <typename Vector>
double distance_to_segment(const Vector& point, const Vector& begin, const Vector& end) {
  const Vector way = end - begin;
  const double length = way.squaredNorm();
  const double along = length > 0 ? std::clamp((point - begin).dot(way) / length, 0.0, 1.0) : 0.0;
  return (point - (begin + along * way)).norm();
}

/// The distance of a point to a convex polygon, counter-clockwise, which may be a segment or a point. It is 0
/// inside. A polygon that is hardly wider than its own rounding has no inside.
template <typename Vector>
double distance_to_outline(const Vector& point, const std::vector<Vector>& outline) {
  double distance = (point - outline.front()).norm();
  bool is_inside = outline.size() > 2;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector& begin = outline[i];
    const Vector& end = outline[(i + 1) % outline.size()];
    distance = std::min(distance, distance_to_segment(point, begin, end));
    const Vector way = point - begin;
    const Vector edge = end - begin;
    is_inside = is_inside && cross(edge, way) > least_sine * edge.norm() * way.norm();
  }
  return is_inside ? 0 : distance;
}

}  // namespace

bool CarryingChoice::choose(std::vector<Contact>& contacts, std::span<const Contact> last,
                            const CarryingRule& rule) {
  collect(contacts);
  if (candidates_.empty()) {  // nothing but edges that pierce
    const std::size_t all = contacts.size();
    contacts.resize(std::min(all, rule.most), Contact{});
    return all > rule.most;
  }
  find_listed(contacts, last);
  keep_band(rule.band);
  Candidate& leader = *find_leader(contacts, rule.band);
  find_places(contacts, leader);
  places_.clear();
  chosen_ = 0;
  add_other_directions(contacts, rule);
  add(leader);
  spread(rule.most);
  std::size_t kept = 0;
  bool has_more = false;
  for (const Candidate& candidate : candidates_)
    if (candidate.is_chosen)
      contacts[kept++] = contacts[candidate.index];
    else
      has_more = has_more || candidate.is_directed || !candidate.is_covered;
  contacts.resize(kept, Contact{});
  return has_more;
}

/// Takes all contacts but edges that pierce.
void CarryingChoice::collect(std::span<const Contact> contacts) {
  candidates_.clear();
  for (std::uint32_t i = 0; i < contacts.size(); ++i)
    if (!is_piercing(contacts[i]))
      candidates_.push_back({.index = i, .separation = contacts[i].separation()});
}

/// Marks the contacts that the last report lists. One that is listed there by other features, because its
/// vertex has come to another face, is the nearest of those that share a vertex with it.
void CarryingChoice::find_listed(std::span<const Contact> contacts, std::span<const Contact> last) {
  lost_.clear();
  auto candidate = candidates_.begin();
  for (std::uint32_t i = 0; i < last.size(); ++i) {
    if (is_piercing(last[i])) continue;
    while (candidate != candidates_.end() && comes_before(contacts[candidate->index], last[i])) ++candidate;
    if (candidate != candidates_.end() && !comes_before(last[i], contacts[candidate->index]))
      candidate->was_listed = true;
    else
      lost_.push_back(i);
  }
  for (const std::uint32_t i : lost_) {
    Candidate* nearest = nullptr;
    double least = 0;
    for (Candidate& each : candidates_) {
      const Contact& contact = contacts[each.index];
      if (each.was_listed || !share_vertex(contact, last[i])) continue;
      const double squared = (middle_of(contact) - middle_of(last[i])).squaredNorm();
      if (nearest != nullptr && squared >= least) continue;
      nearest = &each;
      least = squared;
    }
    if (nearest != nullptr) nearest->was_listed = true;
  }
}

/// Leaves out what is not deep enough.
void CarryingChoice::keep_band(double band) {
  double deepest = candidates_.front().separation;
  for (const Candidate& each : candidates_) deepest = std::min(deepest, each.separation);
  std::erase_if(candidates_, [&](const Candidate& each) { return each.separation > deepest + band; });
  for (Candidate& each : candidates_) {
    // The fourth power, so that what is near the end of the band does not win by being far out.
    const double left = band > 0 ? std::max(0.0, 1 - (each.separation - deepest) / band) : 1;
    each.worth = left * left * left * left;
  }
}

/// The contact that leads among those that no leader covers yet. Null if there is none. It is a listed one if
/// one of these is deep enough.
CarryingChoice::Candidate* CarryingChoice::find_leader(std::span<const Contact> contacts, double band) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double count = 0;
  double deepest = infinity;
  double deepest_listed = infinity;
  for (const Candidate& each : candidates_) {
    if (each.is_covered) continue;
    middle += middle_of(contacts[each.index]);
    ++count;
    deepest = std::min(deepest, each.separation);
    if (each.was_listed) deepest_listed = std::min(deepest_listed, each.separation);
  }
  const bool goes_on = deepest_listed <= deepest + part_to_lead * band;
  const double least = goes_on ? deepest_listed : deepest;
  Candidate* leader = nullptr;
  double farthest = 0;
  for (Candidate& each : candidates_) {
    if (each.is_covered || (goes_on && !each.was_listed)) continue;
    if (each.separation > least + part_of_even * band) continue;
    const double squared = (middle_of(contacts[each.index]) - middle / count).squaredNorm();
    if (leader != nullptr && squared <= farthest) continue;
    farthest = squared;
    leader = &each;
  }
  return leader;
}

/// Marks what pushes as a leader does.
void CarryingChoice::cover(std::span<const Contact> contacts, const Candidate& leader) {
  const Eigen::Vector3d push = contacts[leader.index].push();
  for (Candidate& each : candidates_)
    if (contacts[each.index].push().dot(push) > least_cosine) each.is_covered = true;
}

/// Finds what pushes as the first leader does, and the places of it in the plane square to that push.
void CarryingChoice::find_places(std::span<const Contact> contacts, const Candidate& leader) {
  cover(contacts, leader);
  const Eigen::Vector3d push = contacts[leader.index].push();
  Eigen::Index shortest = 0;
  push.cwiseAbs().minCoeff(&shortest);
  const Eigen::Vector3d first = push.cross(Eigen::Vector3d::Unit(shortest)).normalized();
  const Eigen::Vector3d second = push.cross(first);
  const Eigen::Vector3d origin = middle_of(contacts[leader.index]);
  for (Candidate& each : candidates_) {
    each.is_directed = each.is_covered;
    const Eigen::Vector3d way = middle_of(contacts[each.index]) - origin;
    each.place = {way.dot(first), way.dot(second)};
  }
}

/// Chooses one contact for each other direction, as long as enough are left for the first.
void CarryingChoice::add_other_directions(std::span<const Contact> contacts, const CarryingRule& rule) {
  if (rule.most <= least_of_first) return;
  for (std::size_t left = (rule.most - least_of_first) / 2; left > 0; --left) {
    Candidate* const leader = find_leader(contacts, rule.band);
    if (leader == nullptr) return;
    cover(contacts, *leader);
    leader->is_chosen = true;
    ++chosen_;
  }
}

/// Chooses until there are so many, or no more. First it widens the outline of what is chosen. When that
/// holds all the others, it fills the gaps.
void CarryingChoice::spread(std::size_t most) {
  double overhang = 0;  // what counts as outside
  while (chosen_ < most) {
    find_outline();
    for (Candidate& each : candidates_) each.distance = distance_to_outline(each.place, outline_);
    Candidate* const next = find_next(overhang);
    if (next == nullptr) break;
    if (places_.size() == 1) overhang = part_of_extent * next->distance;
    add(*next);
  }
  for (Candidate& each : candidates_) {
    each.distance = std::numeric_limits<double>::infinity();
    for (const Place& place : places_) each.distance = std::min(each.distance, (each.place - place).norm());
  }
  while (chosen_ < most) {
    Candidate* const next = find_next(0);
    if (next == nullptr) break;
    add(*next);
    for (Candidate& each : candidates_)
      each.distance = std::min(each.distance, (each.place - next->place).norm());
  }
}

/// The candidate that gains most, or one that was listed and gains nearly as much. Null if none gains enough.
CarryingChoice::Candidate* CarryingChoice::find_next(double least_gain) {
  Candidate* best = nullptr;
  Candidate* listed = nullptr;
  for (Candidate& each : candidates_) {
    if (each.is_chosen || !each.is_directed) continue;
    if (best == nullptr || each.gain() > best->gain()) best = &each;
    if (each.was_listed && (listed == nullptr || each.gain() > listed->gain())) listed = &each;
  }
  if (best == nullptr) return nullptr;
  const double enough_to_stay = part_to_stay * std::max(least_gain, best->gain());
  if (listed != nullptr && listed->gain() >= enough_to_stay) return listed;
  return best->gain() >= least_gain ? best : nullptr;
}

void CarryingChoice::add(Candidate& candidate) {
  candidate.is_chosen = true;
  ++chosen_;
  const auto is_left_of = [](const Place& left, const Place& right) {
    return left.x() != right.x() ? left.x() < right.x() : left.y() < right.y();
  };
  const auto at = std::lower_bound(places_.begin(), places_.end(), candidate.place, is_left_of);
  if (at == places_.end() || *at != candidate.place) places_.insert(at, candidate.place);
}

/// Finds the convex hull of all places that are chosen: first its lower side, then its upper one.
void CarryingChoice::find_outline() {
  outline_.clear();
  const auto append = [&](const Place& place, std::size_t begin) {
    while (outline_.size() > begin + 1) {
      const Place& corner = outline_.back();
      const Place& before = outline_[outline_.size() - 2];
      if (cross<Place>(corner - before, place - corner) > 0) break;
      outline_.pop_back();
    }
    outline_.push_back(place);
  };
  for (const Place& place : places_) append(place, 0);
  const std::size_t lower = outline_.size() - 1;
  for (std::size_t i = places_.size() - 1; i-- > 0;) append(places_[i], lower);
  if (outline_.size() > 1) outline_.pop_back();  // the first again
}

void CarryingChoice::reserve(std::size_t contacts) {
  candidates_.reserve(contacts);
  lost_.reserve(contacts);
  places_.reserve(contacts);
  outline_.reserve(contacts + 1);
}

}  // namespace graze
