#include <algorithm>
#include <cmath>
#include <graze/error.hpp>
#include <graze/patch.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/pose.hpp"
#include "core/base/bad_vertex_text.hpp"
#include "core/base/floating_point_scope.hpp"
#include "core/base/view_check.hpp"
#include "core/pair/group_filter.hpp"
#include "core/pair/setting_checks.hpp"
#include "core/search/pair_detector.hpp"
#include "core/surface/surface.hpp"
#include "patches/kept_patches.hpp"

namespace graze {
namespace {

std::array<double, 12> checked_rows(const Eigen::Isometry3d& pose) {
  const std::array<double, 12> rows = rows_of(pose);
  if (const auto problem = problem_of_pose(rows)) throw Error("patch: " + *problem);
  return rows;
}

void check_threshold(double threshold) {
  if (const auto problem = problem_of_distance("patch: ", "threshold", threshold)) throw Error(*problem);
}

void check_positions(const PositionView& positions, const IndexedMesh& mesh) {
  if (const auto problem = problem_of_view(positions, mesh.vertex_count()))
    throw Error("patch got " + problem->got);
}

[[noreturn]] void refuse(std::uint32_t vertex, const Eigen::Vector3d& position) {
  throw Error("patch: " + bad_vertex_text(vertex, position));
}

/// How far the vertex of a tool has come that came furthest, at least. `position_of` says where each is now.
template <typename PositionOf>
double travel_of(const Surface& tool, const PositionOf& position_of) {
  double furthest_squared = 0;
  const PositionView before = tool.positions();
  for (std::uint32_t vertex = 0; vertex < tool.mesh().vertex_count(); ++vertex) {
    if (!tool.mesh().is_used(vertex)) continue;
    const Eigen::Vector3d now = position_of(vertex);
    if (!Surface::is_within_limits(now)) refuse(vertex, now);
    furthest_squared = std::max(furthest_squared, (now - before[vertex]).squaredNorm());
  }
  return std::sqrt(furthest_squared) * round_up + lost_to_underflow;
}

/// How near the faces may be that are not in a patch, at least, if the tool has come so far. It is negative
/// where the tool may have come further than they were.
double covered(const KeptPatch& patch, double travel) {
  const double left = patch.radius - travel;
  return left > 0 ? left * round_down : left;
}

PatchAnswer answer_of(double covered, double threshold) {
  PatchAnswer answer;
  answer.complete = covered >= threshold;
  answer.threshold = std::min(covered, threshold);
  answer.validity = answer.complete ? (covered - threshold) * round_down : 0;
  return answer;
}

}  // namespace

/// The tool's surface and the search, with the memory that both keep.
struct PatchRoom::State {
  void begin(const KeptPatch& patch);
  void search(const KeptPatch& patch, double threshold);
  void search(const KeptPatch& patch, const KeptPatchObject& object, double threshold);
  void take_answer(ObjectId a, ObjectId b);

  std::optional<Surface> tool;
  PairDetector detector;
  PairAnswer answer;
  PairCounters counters;
  std::vector<PatchPair> pairs;
  std::vector<Contact> contacts;
};

/// Empties the room, and has a surface of the tool's mesh.
void PatchRoom::State::begin(const KeptPatch& patch) {
  pairs.clear();
  contacts.clear();
  const auto& mesh = patch.surface->surface.shared_mesh();
  if (!tool || &tool->mesh() != mesh.get()) tool.emplace(mesh);
}

void PatchRoom::State::search(const KeptPatch& patch, double threshold) {
  tool->refit_faces();
  for (const KeptPatchObject& object : patch.objects) search(patch, object, threshold);
}

void PatchRoom::State::search(const KeptPatch& patch, const KeptPatchObject& object, double threshold) {
  const Surface& other = object.surface->part.surface();
  const Surface& a = object.is_first ? other : *tool;
  const Surface& b = object.is_first ? *tool : other;
  PairQuery query;
  query.detail = ContactDetail::nearest;
  query.threshold = query.reach = threshold;
  query.a_is_solid = object.is_first ? object.solid : patch.solid;
  query.b_is_solid = object.is_first ? patch.solid : object.solid;
  PairDetector::outer_bounds(a, b, query, answer);
  if (!answer.listed) return;
  const FaceGroups* const of_a = (object.is_first ? object.groups : patch.groups).get();
  const FaceGroups* const of_b = (object.is_first ? patch.groups : object.groups).get();
  const FeatureFilter hidden(of_a, of_b);
  if (object.ignored != nullptr)
    query.groups = object.ignored.get();
  else if (!hidden.leaves_all())
    query.groups = &hidden;
  detector.detect(a, b, query, answer, counters);
  if (answer.in_contact)
    take_answer(object.is_first ? object.id : patch.tool, object.is_first ? patch.tool : object.id);
}

void PatchRoom::State::take_answer(ObjectId a, ObjectId b) {
  pairs.push_back({a, b, answer.inside, contacts.size(), answer.contacts.size()});
  contacts.insert(contacts.end(), answer.contacts.begin(), answer.contacts.end());
}

PatchRoom::PatchRoom() : state_(std::make_unique<State>()) {}
PatchRoom::~PatchRoom() = default;
PatchRoom::PatchRoom(PatchRoom&& other) noexcept = default;
PatchRoom& PatchRoom::operator=(PatchRoom&& other) noexcept = default;

std::span<const PatchPair> PatchRoom::pairs() const {
  return state_->pairs;
}
std::span<const Contact> PatchRoom::contacts() const {
  return state_->contacts;
}

ObjectId Patch::tool() const {
  return kept_ == nullptr ? ObjectId{} : kept_->tool;
}
double Patch::radius() const {
  return kept_ == nullptr ? 0 : std::max(kept_->radius, 0.0);
}
bool Patch::is_cut() const {
  return kept_ != nullptr && kept_->cut;
}
std::size_t Patch::face_count() const {
  return kept_ == nullptr ? 0 : kept_->faces.size();
}
std::span<const ObjectId> Patch::objects() const {
  return kept_ == nullptr ? std::span<const ObjectId>() : kept_->ids;
}

std::span<const std::uint32_t> Patch::faces(ObjectId object) const {
  const KeptPatchObject* const found = kept_ == nullptr ? nullptr : kept_->find(object);
  if (found == nullptr) return {};
  return std::span(kept_->faces).subspan(found->first_face, found->face_count);
}

PositionView Patch::positions(ObjectId object) const {
  const KeptPatchObject* const found = kept_ == nullptr ? nullptr : kept_->find(object);
  return found == nullptr ? PositionView() : found->surface->part.surface().positions();
}

PatchAnswer Patch::contacts(const Eigen::Isometry3d& pose, double threshold, PatchRoom& room) const {
  const FloatingPointScope scope;
  return fill(threshold, room, [&](Surface& tool) { return tool.set_pose(checked_rows(pose)); });
}

PatchAnswer Patch::contacts(PositionView positions, double threshold, PatchRoom& room) const {
  const FloatingPointScope scope;
  return fill(threshold, room, [&](Surface& tool) {
    check_positions(positions, tool.mesh());
    return tool.set_positions(positions);
  });
}

template <typename Move>
PatchAnswer Patch::fill(double threshold, PatchRoom& room, const Move& move) const {
  PatchRoom::State& state = *room.state_;
  state.pairs.clear();
  state.contacts.clear();
  check_threshold(threshold);
  if (kept_ == nullptr) return {false, -1, 0};
  state.begin(*kept_);
  const Surface::ReadResult read = move(*state.tool);
  if (!read.taken()) refuse(read.bad_vertex, read.bad_position);
  const double travel =
      travel_of(kept_->surface->surface, [&](std::uint32_t vertex) { return state.tool->position(vertex); });
  const PatchAnswer answer = answer_of(covered(*kept_, travel), threshold);
  if (answer.threshold >= 0) state.search(*kept_, answer.threshold);
  return answer;
}

double Patch::validity(const Eigen::Isometry3d& pose, std::optional<double> threshold) const {
  const FloatingPointScope scope;
  const std::array<double, 12> rows = checked_rows(pose);
  return validity_at(threshold, [&](std::uint32_t vertex) {
    return Surface::posed(rows, kept_->surface->surface.mesh().rest()[vertex]);
  });
}

double Patch::validity(PositionView positions, std::optional<double> threshold) const {
  const FloatingPointScope scope;
  if (kept_ != nullptr) check_positions(positions, kept_->surface->surface.mesh());
  return validity_at(threshold, [&](std::uint32_t vertex) { return positions[vertex]; });
}

template <typename PositionOf>
double Patch::validity_at(std::optional<double> threshold, const PositionOf& position_of) const {
  if (threshold) check_threshold(*threshold);
  if (kept_ == nullptr) return 0;
  const double travel = travel_of(kept_->surface->surface, position_of);
  return answer_of(covered(*kept_, travel), threshold.value_or(kept_->threshold)).validity;
}

}  // namespace graze
