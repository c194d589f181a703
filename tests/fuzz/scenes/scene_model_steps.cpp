// The model's side of each step of a scene: the report that the step must give.

#include <algorithm>
#include <graze/scene_enumerators.hpp>
#include <limits>

#include "fuzz/finding.hpp"
#include "scene_model.hpp"
#include "scheduler/report_text.hpp"

namespace graze::fuzz {
namespace {

/// Whether something met on the way, or came near.
bool met(const PairReport& row) {
  return row.impact_count > 0 || row.time_of_gap < 1;
}

bool is_contact(const PairReport& row) {
  return row.phase == PairPhase::began || row.phase == PairPhase::touching;
}

/// Whether a budget ran out before the row had an answer. Limits of contacts leave it an answer.
bool is_undone(const PairReport& row) {
  return !row.complete && !row.contacts_cut;
}

/// Every bit of a row and its contacts, but for what depends on the steps before and on the objects' ids.
std::string timeless(const FrameReport& report, PairReport row) {
  row.a = {};
  row.b = {};
  row.phase = PairPhase::near;
  return tests::text_of(report, row);
}

/// Every bit of a row but for what says which contacts are listed, and what met on the way.
std::string without_contacts(const FrameReport& report, PairReport row) {
  row.contact_count = 0;
  row.impact_count = 0;
  row.time_of_impact = row.time_of_gap = 1;
  row.contacts_cut = false;
  row.complete = true;
  return timeless(report, row);
}

bool are_same(const Contact& a, const Contact& b) {
  return a.kind == b.kind && a.feature_a == b.feature_a && a.feature_b == b.feature_b &&
         a.point_a == b.point_a && a.point_b == b.point_b && a.normal == b.normal &&
         a.distance == b.distance && a.side_a == b.side_a && a.side_b == b.side_b && a.sunk == b.sunk;
}

bool carries(const Contact& contact) {
  return contact.kind != ContactKind::EF || contact.distance != 0;
}

/// The least separation of contacts that carry, or infinity where there are none.
double depth_of(std::span<const Contact> contacts) {
  double depth = std::numeric_limits<double>::infinity();
  for (const Contact& contact : contacts)
    if (carries(contact)) depth = std::min(depth, contact.separation());
  return depth;
}

}  // namespace

bool SceneModel::is_gone(const BodyPair& pair) const {
  return !bodies_[pair.first].is_alive || !bodies_[pair.second].is_alive;
}

bool SceneModel::is_frozen(const BodyPair& pair) const {
  return bodies_[pair.first].is_frozen || bodies_[pair.second].is_frozen;
}

PairRule SceneModel::rule_of(const BodyPair& pair) const {
  const auto kinds = std::minmax(bodies_[pair.first].settings.kind, bodies_[pair.second].settings.kind);
  const auto rule = rules_.find(kinds);
  return rule == rules_.end() ? PairRule{} : rule->second;
}

double SceneModel::threshold_of(const BodyPair& pair) const {
  return rule_of(pair).contact_distance.value_or(scene_.settings().contact_distance) +
         (bodies_[pair.first].settings.margin + bodies_[pair.second].settings.margin);
}

double SceneModel::range_of(const BodyPair& pair) const {
  return std::max(rule_of(pair).range.value_or(scene_.settings().range), threshold_of(pair));
}

std::map<SceneModel::BodyPair, SceneModel::Fresh> SceneModel::build_afresh() const {
  SceneSettings settings = scene_.settings();
  settings.range = std::numeric_limits<double>::infinity();
  settings.accuracy = Accuracy::exact();
  settings.threads = 1;
  settings.time_budget.reset();
  settings.work_budget.reset();
  if (chooses_carrying()) {
    settings.carrying = 0;
    settings.max_contacts.reset();
    settings.max_contacts_per_pair.reset();
  }
  Scene afresh(settings);
  std::vector<ObjectId> ids(bodies_.size());
  std::map<ObjectId, std::size_t> body_of;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const ModelBody& body = bodies_[i];
    if (!body.is_alive || body.is_frozen) continue;
    ids[i] = afresh.add(body.mesh, body.settings);
    body_of[ids[i]] = i;
  }
  for (const auto& [a, b] : ignored_)
    if (ids[a] != ObjectId{} && ids[b] != ObjectId{}) afresh.ignore(ids[a], ids[b]);
  for (const auto& [a, b] : ignored_groups_)
    if (ids[a.body] != ObjectId{} && ids[b.body] != ObjectId{})
      afresh.ignore(ids[a.body], a.group, ids[b.body], b.group);
  for (auto [kinds, rule] : rules_) {
    rule.range = settings.range;
    afresh.set_rule(kinds.first, kinds.second, rule);
  }
  const auto place = [&](bool at_start) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const ModelBody& body = bodies_[i];
      const std::optional<PoseRows>& pose = at_start ? body.start_pose : body.pose;
      if (ids[i] == ObjectId{}) continue;
      if (body.settings.motion == Motion::deformable)
        afresh.set_positions(ids[i], at_start ? body.start : body.seen);
      else if (pose)
        afresh.set_pose_rows(ids[i], *pose);
    }
  };
  if (sweeps()) {
    place(true);
    (void)afresh.step();
  }
  place(false);
  std::map<BodyPair, Fresh> rows;
  const ReportHandle report = afresh.step();
  expect(report->diagnostics().empty(), "a scene built afresh has a diagnostic");
  for (const PairReport& row : report->pairs())
    rows[{body_of.at(row.a), body_of.at(row.b)}] = {report, &row, is_contact(row)};
  return rows;
}

void SceneModel::step() {
  for (ModelBody& body : bodies_)
    if (body.is_alive) read_and_sweep(body);
  const ReportHandle report = scene_.step();
  expect(report->frame() == ++frame_, "frames are not counted one by one");
  expect(scene_.latest_report()->frame() == frame_, "the latest report is not the last step's");
  const auto alive =
      std::count_if(bodies_.begin(), bodies_.end(), [](const ModelBody& body) { return body.is_alive; });
  expect(scene_.object_count() == static_cast<std::size_t>(alive), "another number of objects");
  const std::string problem = tests::inconsistency_of(*report);
  if (!problem.empty()) finding(problem);
  check_limits(*report);
  check_diagnostics(*report);
  check_rows(*report, build_afresh());
  check_queries(report);
  check_patches(report);
  is_swept_added_ = false;
}

bool SceneModel::sweeps() const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [](const ModelBody& body) { return body.is_alive && body.settings.swept; });
}

bool SceneModel::is_sweep_known(const BodyPair& pair) const {
  return bodies_[pair.first].is_start_known && bodies_[pair.second].is_start_known;
}

void SceneModel::check_limits(const FrameReport& report) const {
  const SceneSettings& settings = scene_.settings();
  expect(report.contacts().size() <= settings.max_contacts.value_or(report.contacts().size()),
         "more contacts than the limit");
  for (const PairReport& row : report.pairs()) {
    expect(row.contact_count <= settings.max_contacts_per_pair.value_or(row.contact_count),
           "more contacts of a pair than the limit");
    expect(!chooses_carrying() || row.contact_count <= settings.carrying,
           "more contacts than may carry a pair");
    expect(settings.ways_out || row.way_out.fullness == 0, "a way out that nobody asked for");
  }
}

bool SceneModel::chooses_carrying() const {
  return scene_.settings().carrying > 0 && scene_.settings().detail == ContactDetail::nearest;
}

bool SceneModel::has_other_limits(const FrameReport& report) const {
  if (!scene_.settings().max_contacts) return false;
  const auto rows = report.pairs();
  return std::any_of(rows.begin(), rows.end(),
                     [](const PairReport& row) { return row.stale || is_undone(row); });
}

void SceneModel::check_diagnostics(const FrameReport& report) {
  std::multiset<std::pair<ObjectId, DiagnosticKind>> found;
  std::string messages;
  for (const Diagnostic& diagnostic : report.diagnostics()) {
    found.emplace(diagnostic.object, diagnostic.kind);
    messages += diagnostic.message + "\n";
  }
  std::string wanted;
  for (const auto& [id, kind] : expected_)
    wanted += std::string(to_string(kind)) + " of " + std::to_string(id.index) + "\n";
  if (found != expected_) finding("diagnostics:\n" + messages + "instead of:\n" + wanted);
  expected_.clear();
}

bool SceneModel::must_be_listed(const BodyPair& pair, const Fresh& fresh) const {
  if (met(*fresh.row) && is_sweep_known(pair)) return true;
  const double reach = range_of(pair);
  // Bounds are the distance rounded down and up: it is below a double exactly where the lower one is.
  return fresh.in_contact || fresh.row->distance.lower < reach;
}

void SceneModel::check_rows(const FrameReport& report, const std::map<BodyPair, Fresh>& fresh) {
  std::set<BodyPair> listed;
  std::set<BodyPair> now_in_contact;
  for (const PairReport& row : report.pairs()) {
    expect(body_of_.contains(row.a) && body_of_.contains(row.b), "a row of an object that never was");
    const BodyPair pair(body_of_.at(row.a), body_of_.at(row.b));
    expect(pair.first <= pair.second && (listed.empty() || *listed.rbegin() < pair), "rows out of order");
    listed.insert(pair);
    expect(row.user_data_a == bodies_[pair.first].settings.user_data &&
               row.user_data_b == bodies_[pair.second].settings.user_data,
           "other user data than the objects have");
    const auto known = fresh.find(pair);
    check_row(report, row, pair, known == fresh.end() ? nullptr : &known->second);
    if (is_contact(row)) now_in_contact.insert(pair);
  }
  const bool is_paper = scene_.settings().accuracy.mode() == AccuracyMode::paper;
  for (const auto& [pair, known] : fresh)
    if (must_be_listed(pair, known) && !is_paper)
      if (!listed.contains(pair)) finding("a pair is not listed:\n" + timeless(*known.report, *known.row));
  for (const BodyPair& pair : in_contact_)
    if (is_gone(pair) || !is_frozen(pair))
      expect(listed.contains(pair), "a pair that was in contact is not listed");
  in_contact_ = now_in_contact;
}

void SceneModel::check_row(const FrameReport& report, const PairReport& row, const BodyPair& pair,
                           const Fresh* fresh) const {
  const bool was = in_contact_.contains(pair);
  expect((row.impact_count == 0 && row.time_of_impact == 1 && row.time_of_gap == 1) ||
             bodies_[pair.first].settings.swept || bodies_[pair.second].settings.swept,
         "a sweep that nobody asked for");
  if (is_gone(pair)) {
    expect(row.phase == PairPhase::ended && was, "a row of an object that is gone");
    return expect(!row.stale && row.complete && row.contact_count == 0, "what the last row of a pair says");
  }
  if (is_frozen(pair)) {
    expect(row.stale || row.phase == PairPhase::ended, "a row of an object that cannot be read is not stale");
    return;
  }
  expect(!row.stale, "a row of objects that can be read is stale");
  // A surface of which no two features may be tested: a budget ends before the search finds that out.
  if (fresh == nullptr && pair.first == pair.second && is_undone(row)) return;
  if (fresh == nullptr) {
    if (row.phase == PairPhase::ended && was) return;
    finding("a row of a pair that is filtered out:\n" + timeless(report, row));
  }
  check_values(report, row, pair, *fresh);
  if (scene_.settings().accuracy.mode() == AccuracyMode::paper) return;
  if (is_undone(row))
    return expect(row.phase == (was ? PairPhase::touching : PairPhase::near),
                  "the phase of a row that is not complete");
  const PairPhase expected = fresh->in_contact ? (was ? PairPhase::touching : PairPhase::began)
                                               : (was ? PairPhase::ended : PairPhase::near);
  if (row.phase != expected)
    finding("phase " + std::string(to_string(row.phase)) + " instead of " + std::string(to_string(expected)));
  expect(expected != PairPhase::near || row.distance.lower < range_of(pair) || met(row),
         "a pair that is not near is listed");
}

void SceneModel::check_values(const FrameReport& report, const PairReport& row, const BodyPair& pair,
                              const Fresh& fresh) const {
  const Accuracy& accuracy = scene_.settings().accuracy;
  const DistanceBounds& truth = fresh.row->distance;
  // The truth lies between two neighbouring doubles, or is one.
  if (row.distance.lower > truth.lower || row.distance.upper < truth.upper)
    finding("bounds that do not hold:\n" + timeless(report, row) + "\nand of a scene built afresh:\n" +
            timeless(*fresh.report, *fresh.row));
  if (accuracy.mode() == AccuracyMode::paper || is_undone(row)) return;
  if (accuracy.mode() == AccuracyMode::within && !fresh.in_contact) {
    const double rounding = 0x1p-50 * row.distance.upper;
    // Both are infinite where nothing is left to be tested.
    return expect(row.distance.lower == row.distance.upper ||
                      row.distance.upper - row.distance.lower <= accuracy.tolerance() + rounding,
                  "bounds further apart than the tolerance");
  }
  if (chooses_carrying()) return check_chosen(report, row, pair, fresh);
  if (has_other_limits(report)) return;
  if (!is_sweep_known(pair)) {
    const std::string mine = without_contacts(report, row);
    if (mine != without_contacts(*fresh.report, *fresh.row))
      finding("a row whose way is not known:\n" + mine);
    return;
  }
  const std::string mine = timeless(report, row);
  const std::string other = timeless(*fresh.report, *fresh.row);
  if (mine != other) finding("a row of the scene:\n" + mine + "\nand of one built afresh:\n" + other);
}

void SceneModel::check_chosen(const FrameReport& report, const PairReport& row, const BodyPair& pair,
                              const Fresh& fresh) const {
  const std::string mine = without_contacts(report, row);
  const std::string other = without_contacts(*fresh.report, *fresh.row);
  if (mine != other) finding("a row of the scene:\n" + mine + "\nand of one built afresh:\n" + other);
  const auto chosen = report.contacts(row);
  const auto all = fresh.report->contacts(*fresh.row);
  const double least = depth_of(all) + scene_.settings().carrying_band.value_or(threshold_of(pair));
  for (const Contact& contact : chosen) {
    expect(std::any_of(all.begin(), all.end(), [&](const Contact& one) { return are_same(one, contact); }),
           "a contact was chosen that is none");
    expect(!carries(contact) || contact.separation() <= least,
           "a contact was chosen that is not deep enough");
    expect(carries(contact) || std::none_of(all.begin(), all.end(), carries),
           "an edge that pierces was chosen to carry");
  }
  if (scene_.settings().max_contacts) return;
  expect(all.empty() == chosen.empty(), "none of the contacts of a pair was chosen");
}

}  // namespace graze::fuzz
