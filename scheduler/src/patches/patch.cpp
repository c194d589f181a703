#include <algorithm>
#include <array>
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
  void clear() {
    pairs.clear();
    contacts.clear();
  }
  /// Has a surface of the tool's mesh.
  void have_tool_of(const KeptPatch& patch);
  void search(const KeptPatch& patch, double threshold);

  std::optional<Surface> tool;
  std::vector<PatchPair> pairs;
  std::vector<Contact> contacts;

 private:
  /// One of the two objects of a pair.
  struct Side {
    ObjectId id;
    const Surface& surface;
    bool solid;
    const FaceGroups* groups;
  };

  void search(const Side& a, const Side& b, const GroupFilter* ignored, double threshold);

  PairDetector detector_;
  PairAnswer answer_;
  PairCounters counters_;
};

void PatchRoom::State::have_tool_of(const KeptPatch& patch) {
  const auto& mesh = patch.surface->surface.shared_mesh();
  if (!tool || &tool->mesh() != mesh.get()) tool.emplace(mesh);
}

void PatchRoom::State::search(const KeptPatch& patch, double threshold) {
  tool->refit_faces();
  const Side of_tool{patch.tool, *tool, patch.solid, patch.groups.get()};
  for (const KeptPatchObject& object : patch.objects) {
    const Side other{object.id, object.surface->part.surface(), object.solid, object.groups.get()};
    search(object.is_first ? other : of_tool, object.is_first ? of_tool : other, object.ignored.get(),
           threshold);
  }
}

void PatchRoom::State::search(const Side& a, const Side& b, const GroupFilter* ignored, double threshold) {
  PairQuery query;
  query.detail = ContactDetail::nearest;
  query.threshold = query.reach = threshold;
  query.a_is_solid = a.solid;
  query.b_is_solid = b.solid;
  PairDetector::outer_bounds(a.surface, b.surface, query, answer_);
  if (!answer_.listed) return;
  const FeatureFilter hidden(a.groups, b.groups);
  query.groups = ignored;
  if (ignored == nullptr && !hidden.leaves_all()) query.groups = &hidden;
  detector_.detect(a.surface, b.surface, query, answer_, counters_);
  if (!answer_.in_contact) return;
  pairs.push_back({a.id, b.id, answer_.inside, contacts.size(), answer_.contacts.size()});
  contacts.insert(contacts.end(), answer_.contacts.begin(), answer_.contacts.end());
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

namespace {

/// Fills a room for a tool that `move(surface)` puts where it is to be.
template <typename State, typename Move>
PatchAnswer fill(const KeptPatch* patch, double threshold, State& room, const Move& move) {
  room.clear();
  check_threshold(threshold);
  if (patch == nullptr) return {false, -1, 0};
  room.have_tool_of(*patch);
  const Surface::ReadResult read = move(*room.tool);
  if (!read.taken()) refuse(read.bad_vertex, read.bad_position);
  const double travel =
      travel_of(patch->surface->surface, [&](std::uint32_t vertex) { return room.tool->position(vertex); });
  const PatchAnswer answer = answer_of(covered(*patch, travel), threshold);
  if (answer.threshold >= 0) room.search(*patch, answer.threshold);
  return answer;
}

/// PatchAnswer::validity of a tool whose vertices are where `position_of(vertex)` says.
template <typename PositionOf>
double validity_of(const KeptPatch* patch, std::optional<double> threshold, const PositionOf& position_of) {
  if (threshold) check_threshold(*threshold);
  if (patch == nullptr) return 0;
  const double travel = travel_of(patch->surface->surface, position_of);
  return answer_of(covered(*patch, travel), threshold.value_or(patch->threshold)).validity;
}

}  // namespace

PatchAnswer Patch::contacts(const Eigen::Isometry3d& pose, double threshold, PatchRoom& room) const {
  const FloatingPointScope scope;
  return fill(kept_, threshold, *room.state_,
              [&](Surface& tool) { return tool.set_pose(checked_rows(pose)); });
}

PatchAnswer Patch::contacts(PositionView positions, double threshold, PatchRoom& room) const {
  const FloatingPointScope scope;
  return fill(kept_, threshold, *room.state_, [&](Surface& tool) {
    check_positions(positions, tool.mesh());
    return tool.set_positions(positions);
  });
}

double Patch::validity(const Eigen::Isometry3d& pose, std::optional<double> threshold) const {
  const FloatingPointScope scope;
  const std::array<double, 12> rows = checked_rows(pose);
  return validity_of(kept_, threshold, [&](std::uint32_t vertex) {
    return Surface::posed(rows, kept_->surface->surface.mesh().rest()[vertex]);
  });
}

double Patch::validity(PositionView positions, std::optional<double> threshold) const {
  const FloatingPointScope scope;
  if (kept_ != nullptr) check_positions(positions, kept_->surface->surface.mesh());
  return validity_of(kept_, threshold, [&](std::uint32_t vertex) { return positions[vertex]; });
}

}  // namespace graze
