#include <algorithm>
#include <graze/pair_query.hpp>

#include "bounds.hpp"
#include "closest_pair.hpp"
#include "feature_pairs.hpp"
#include "measure.hpp"
#include "paper.hpp"
#include "parallel.hpp"
#include "vertex_pairs.hpp"

namespace graze {

void PairCounters::add(const PairCounters& other) {
  region_pairs_tested += other.region_pairs_tested;
  leaf_pairs_tested += other.leaf_pairs_tested;
  discarded_in_float += other.discarded_in_float;
  decided_in_double += other.decided_in_double;
  exact_decisions += other.exact_decisions;
  for (std::size_t level = 0; level < regions_expanded.size(); ++level)
    regions_expanded[level] += other.regions_expanded[level];
}

struct PairDetector::Scratch {
  LeafPairScratch leaf_pairs;
  ClosestScratch closest;
  LeafScratch features;
  std::vector<ContactName> nearest_of_leaves;
  PaperScratch paper;
  std::vector<ContactName> names;
  LeafFront no_front;
};

namespace {

/// Bounds that need no search: the objects' boxes, and the middle vertices of the whole objects.
void set_outer_bounds(const Surface& a, const Surface& b, PairAnswer& answer) {
  const std::uint32_t middle_a = a.mesh().regions().region(0).middle;
  const std::uint32_t middle_b = b.mesh().regions().region(0).middle;
  answer.distance = {lower_distance(a.box(), b.box()),
                     upper_distance(a.position(middle_a), b.position(middle_b))};
  answer.witness = {{FeatureKind::vertex, middle_a},
                    {FeatureKind::vertex, middle_b},
                    a.position(middle_a),
                    b.position(middle_b)};
}

class Detection {
 public:
  Detection(const SurfacePair& pair, const PairQuery& query, LeafFront& front, LeafPairScratch& scratch,
            PairAnswer& answer, WorkMeter& meter)
      : pair_(pair), query_(query), front_(front), leaf_pairs_(scratch), answer_(answer), meter_(meter) {}

  /// All contacts of the detail; where there are none, the closest points.
  void all_contacts(std::vector<ContactName>& names, const auto& find, ClosestScratch& scratch) {
    names.clear();
    LeafPairs leaf_pairs(pair_, query_, front_, leaf_pairs_, meter_);
    answer_.complete = find(leaf_pairs, names);
    if (!answer_.complete) return;
    if (names.empty() && query_.reach <= query_.threshold) return;
    if (names.empty()) return closest_points(Ties::lowest, scratch);
    report(names);
    set_distance(lowest_of(names, scratch.names));
    answer_.in_contact = answer_.listed = true;
  }

  /// The closest points alone; with `ties` all, the one closest contact.
  void closest_points(Ties ties, ClosestScratch& scratch) {
    LeafPairs leaf_pairs(pair_, query_, front_, leaf_pairs_, meter_);
    const ClosestFound found = find_closest(pair_, query_, ties, leaf_pairs, scratch, meter_);
    answer_.complete = found.complete;
    if (!found.complete) return;
    const ContactName& nearest = scratch.names.front();
    const bool about_surfaces = !is_about_vertices(query_.detail);
    answer_.in_contact =
        (about_surfaces && found.pierced) || is_closer_than(pair_, nearest, query_.threshold);
    const bool in_reach = found.lower < query_.reach || is_closer_than(pair_, nearest, query_.reach);
    answer_.listed = answer_.in_contact || in_reach;
    if (!answer_.listed) return;
    set_distance(nearest);
    answer_.distance.lower = std::min(answer_.distance.lower, found.lower);
    if (ties == Ties::lowest || !answer_.in_contact) return;
    answer_.contacts.push_back(closest_contact(pair_, scratch.names));
    answer_.witness = witness_of(answer_.contacts.front());
  }

  void as_in_paper(std::vector<ContactName>& names, PaperScratch& scratch) {
    names.clear();
    const PaperFound found = find_as_in_paper(pair_, query_, scratch, meter_, names);
    answer_.complete = found.complete;
    if (!found.complete) return;
    report(names);
    set_distance(scratch.closest.front());
    answer_.distance.lower = std::min(answer_.distance.lower, found.lower);
    answer_.in_contact = !names.empty();
    answer_.listed = answer_.in_contact || answer_.distance.lower < query_.reach;
  }

 private:
  void report(std::vector<ContactName>& names) {
    std::sort(names.begin(), names.end());
    answer_.contacts.reserve(names.size());
    for (const ContactName& name : names) answer_.contacts.push_back(measure(pair_, name));
  }

  /// The lowest name at the least distance, among contacts that have been measured.
  ContactName lowest_of(const std::vector<ContactName>& names, std::vector<ContactName>& scratch) {
    ClosestSet closest(pair_, Ties::lowest, scratch);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Contact& contact : answer_.contacts) nearest = std::min(nearest, contact.distance);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (answer_.contacts[i].distance <= nearest + closeness_of(answer_.contacts[i]))
        closest.offer(names[i]);
    return closest.names().front();
  }

  /// More than the rounding of a contact's distance, which is relative to the size of its features and their
  /// gap; those are inside the objects' boxes.
  [[nodiscard]] double closeness_of(const Contact& contact) const {
    const double size = (pair_.a.box().max - pair_.a.box().min).maxCoeff() +
                        (pair_.b.box().max - pair_.b.box().min).maxCoeff();
    return (size + contact.distance) * 0x1p-44;
  }

  void set_distance(const ContactName& nearest) {
    answer_.distance = rounded_distance(pair_, nearest);
    answer_.witness = witness_of(measure(pair_, nearest));
  }

  const SurfacePair& pair_;
  const PairQuery& query_;
  LeafFront& front_;
  LeafPairScratch& leaf_pairs_;
  PairAnswer& answer_;
  WorkMeter& meter_;
};

}  // namespace

PairDetector::PairDetector() : scratch_(std::make_unique<Scratch>()) {}
PairDetector::~PairDetector() = default;
PairDetector::PairDetector(PairDetector&&) noexcept = default;
PairDetector& PairDetector::operator=(PairDetector&&) noexcept = default;

void PairDetector::outer_bounds(const Surface& a, const Surface& b, const PairQuery& query,
                                PairAnswer& answer) {
  answer.in_contact = false;
  answer.complete = false;
  answer.contacts.clear();
  set_outer_bounds(a, b, answer);
  answer.listed = answer.distance.lower < query.reach || answer.distance.lower == 0;
}

void PairDetector::detect(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer,
                          PairCounters& counters) {
  scratch_->no_front.forget();
  detect(a, b, query, scratch_->no_front, answer, counters);
}

void PairDetector::detect(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front,
                          PairAnswer& answer, PairCounters& counters) {
  answer.in_contact = answer.listed = false;
  answer.complete = true;
  answer.contacts.clear();
  DecisionCount decisions;
  const SurfacePair pair{a, b, decisions};
  WorkMeter meter(query, counters);
  Scratch& s = *scratch_;
  Detection detection(pair, query, front, s.leaf_pairs, answer, meter);
  if (query.mode == AccuracyMode::paper) {
    detection.as_in_paper(s.names, s.paper);
  } else if (query.detail == ContactDetail::features) {
    detection.all_contacts(
        s.names,
        [&](LeafPairs& leaf_pairs, auto& names) {
          return find_feature_pairs(pair, query, leaf_pairs, s.features, names);
        },
        s.closest);
  } else if (query.detail == ContactDetail::vertices) {
    detection.all_contacts(
        s.names,
        [&](LeafPairs& leaf_pairs, auto& names) {
          return find_vertex_pairs(pair, query, leaf_pairs, s.features, names);
        },
        s.closest);
  } else if (query.detail == ContactDetail::regions) {
    detection.all_contacts(
        s.names,
        [&](LeafPairs& leaf_pairs, auto& names) {
          return find_region_pairs(pair, query, leaf_pairs, s.features, s.nearest_of_leaves, names);
        },
        s.closest);
  } else {
    detection.closest_points(query.detail == ContactDetail::closest ? Ties::all : Ties::lowest, s.closest);
  }
  if (!answer.complete) outer_bounds(a, b, query, answer);
  counters.discarded_in_float += decisions.discarded_in_float;
  counters.decided_in_double += decisions.in_double;
  counters.exact_decisions += decisions.exact;
}

}  // namespace graze
