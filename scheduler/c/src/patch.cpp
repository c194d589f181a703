#include <optional>

#include "calls.hpp"
#include "handles.hpp"
#include "layout.hpp"
#include "positions.hpp"

using graze::c::BadArgument;
using graze::c::given;
using graze::c::guarded;
using graze::c::same;

namespace {

graze::Patch found_patch(const graze_report* report, graze_id tool) {
  return given(report, "report").report().patch(same<graze::ObjectId>(tool));
}

/// The patch of a tool that has one.
graze::Patch patch_of(const graze_report* report, graze_id tool) {
  const graze::Patch patch = found_patch(report, tool);
  if (!patch) throw BadArgument("the report has no patch of this object; give it a patch_radius");
  return patch;
}

std::optional<double> threshold_of(const double* threshold) {
  return threshold == nullptr ? std::nullopt : std::optional<double>(*threshold);
}

template <typename Motion>
graze_status give_contacts(const graze_report* report, graze_id tool, const Motion& motion, double threshold,
                           graze_patch_room* room, graze_patch_answer* answer) {
  return guarded([&] {
    auto& given_answer = given(answer, "answer");
    given_answer = same<graze_patch_answer>(
        patch_of(report, tool).contacts(motion(), threshold, given(room, "room").room));
  });
}

template <typename Motion>
graze_status give_validity(const graze_report* report, graze_id tool, const Motion& motion,
                           const double* threshold, double* validity) {
  return guarded([&] {
    given(validity, "validity") = patch_of(report, tool).validity(motion(), threshold_of(threshold));
  });
}

}  // namespace

extern "C" {

graze_status graze_report_patch(const graze_report* report, graze_id tool, graze_patch* patch) {
  return guarded([&] {
    const graze::Patch found = found_patch(report, tool);
    std::size_t count = 0;
    const auto* const objects = graze::c::c_rows<graze_id>(found.objects(), &count);
    given(patch, "patch") = {static_cast<bool>(found), found.is_cut(), found.radius(),
                             found.face_count(),       objects,        count};
  });
}

graze_status graze_patch_faces(const graze_report* report, graze_id tool, graze_id object,
                               const uint32_t** faces, size_t* count) {
  return guarded([&] {
    const auto found = patch_of(report, tool).faces(same<graze::ObjectId>(object));
    given(faces, "faces") = found.data();
    given(count, "count") = found.size();
  });
}

graze_status graze_patch_positions(const graze_report* report, graze_id tool, graze_id object,
                                   graze_positions* positions) {
  return guarded([&] {
    given(positions, "positions") =
        graze::c::described(patch_of(report, tool).positions(same<graze::ObjectId>(object)));
  });
}

graze_status graze_patch_contacts_at_pose(const graze_report* report, graze_id tool, const double rows[12],
                                          double threshold, graze_patch_room* room,
                                          graze_patch_answer* answer) {
  return give_contacts(
      report, tool, [&] { return graze::c::pose_of(rows); }, threshold, room, answer);
}

graze_status graze_patch_contacts_at_positions(const graze_report* report, graze_id tool,
                                               const graze_positions* positions, double threshold,
                                               graze_patch_room* room, graze_patch_answer* answer) {
  return give_contacts(
      report, tool, [&] { return graze::c::view_of(positions, "positions"); }, threshold, room, answer);
}

graze_status graze_patch_validity_at_pose(const graze_report* report, graze_id tool, const double rows[12],
                                          const double* threshold, double* validity) {
  return give_validity(
      report, tool, [&] { return graze::c::pose_of(rows); }, threshold, validity);
}

graze_status graze_patch_validity_at_positions(const graze_report* report, graze_id tool,
                                               const graze_positions* positions, const double* threshold,
                                               double* validity) {
  return give_validity(
      report, tool, [&] { return graze::c::view_of(positions, "positions"); }, threshold, validity);
}

graze_status graze_patch_room_new(graze_patch_room** room) {
  return guarded([&] {
    auto& made = given(room, "room");
    made = new graze_patch_room;
  });
}

void graze_patch_room_release(graze_patch_room* room) {
  delete room;
}

const graze_patch_pair* graze_patch_room_pairs(const graze_patch_room* room, size_t* count) {
  const auto pairs = room == nullptr ? std::span<const graze::PatchPair>() : room->room.pairs();
  return graze::c::c_rows<graze_patch_pair>(pairs, count);
}

const graze_contact* graze_patch_room_contacts(const graze_patch_room* room, size_t* count) {
  const auto contacts = room == nullptr ? std::span<const graze::Contact>() : room->room.contacts();
  return graze::c::c_rows<graze_contact>(contacts, count);
}

}  // extern "C"
