#pragma once

#include <cstddef>
#include <graze/accuracy.hpp>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/position_view.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace graze {

/// @addtogroup query
/// @{

/// The settings of a query about two surfaces a and b. Distances are in the caller's units. What a scene has
/// under the same name means the same.
struct QuerySettings {
  /// Features that are strictly closer than this are in contact. It is finite, and 0 or more.
  double contact_distance = 0;
  /// The distance up to which the closest points are looked for. It is 0 or more. A query about surfaces that
  /// are further apart is done sooner. See QueryResult::is_in_range.
  double range = std::numeric_limits<double>::infinity();
  /// Selects which contacts are listed.
  ContactDetail detail = ContactDetail::features;
  /// How exact the answer is.
  Accuracy accuracy = Accuracy::exact();
  /// Whether surface a bounds a volume, as ObjectSettings::solid says. It has to be closed then.
  bool a_is_solid = false;
  /// Whether surface b bounds a volume.
  bool b_is_solid = false;
  /// The most contacts that are listed. It is at least 1. No value means no limit. The nearest are kept: by
  /// distance, then by kind and features. With ContactDetail::nearest the deepest are kept: by
  /// Contact::separation() in place of the distance, and edges that pierce come last.
  std::optional<std::size_t> max_contacts = std::nullopt;
  /// Whether the answer says how surfaces that pass through each other leave each other:
  /// QueryResult::way_out. It has no effect with the details `vertices` and `regions`.
  bool ways_out = false;
};

/// The answer of a query about two surfaces a and b.
struct QueryResult {
  /// Whether the surfaces are in contact: closer than the contact distance, or with an edge that pierces a
  /// face, or with a vertex inside the other one's solid. A scene says `began` or `touching` of such a pair,
  /// and `near` of another.
  bool in_contact = false;
  /// Whether the surfaces are in contact, or closer than QuerySettings::range. A scene lists the pair then.
  /// With Accuracy::within() and Accuracy::paper() the lower bound decides, so it may also be true beyond the
  /// range. If it is false, only #distance and #witness say anything. The bounds hold but are not close to
  /// each other, and the lower one is not below the range.
  bool is_in_range = false;
  /// Whether QuerySettings::max_contacts left contacts out. All else is said of all contacts.
  bool contacts_cut = false;
  /// Whether one surface is inside the other, if one of them is a solid.
  Inside inside = Inside::none;
  /// The bounds of the distance of the surfaces, in the caller's units. With the details `vertices` and
  /// `regions` it is the distance of their vertices.
  DistanceBounds distance;
  /// Two points, one of each surface, that are DistanceBounds::upper apart.
  Witness witness;
  /// How b leaves a, if QuerySettings::ways_out asks for it and the surfaces pass through each other.
  /// Otherwise all of it is 0.
  WayOut way_out;
  /// The contacts, sorted by kind, feature a, feature b. Contact::since is 0.
  std::vector<Contact> contacts;
};

/// Finds the distance and the contacts of two surfaces, without a scene. It is for tools, tests and checks.
///
/// `positions_a` are those of the vertices of `mesh_a`, and `positions_b` those of `mesh_b`. Both are in the
/// same units, and are only read. The two meshes may be the same one. The answer has the bits that the first
/// report of a Scene has of two such objects, if a was added before b and no faces are hidden or ignored.
/// With Accuracy::within() other bounds within the tolerance are possible.
///
/// Throws Error for settings that a scene refuses. These are a distance that is negative or NaN, an infinite
/// contact distance, a number that is no detail, and a limit of 0. Others are Accuracy::paper() with a detail
/// about surfaces, and a solid that is not closed. The call also throws Error for positions if there are not
/// as many as vertices, or if their memory is null or not aligned. A vertex that a face uses needs finite
/// coordinates of at most 2^120. Throws `std::bad_alloc` without memory.
///
/// The call computes on the calling thread alone, and in any floating-point mode of the caller. Any number of
/// threads may make it at the same time, also with the same meshes.
[[nodiscard]] GRAZE_API QueryResult query(const Mesh& mesh_a, PositionView positions_a, const Mesh& mesh_b,
                                          PositionView positions_b, const QuerySettings& settings = {});

/// A query that is asked again and again about the same two meshes at other positions. It keeps its memory.
/// So a call takes memory only if it needs more than every call before, and is faster than query().
///
///     graze::RepeatedQuery query(tool_mesh, organ_mesh, {.range = 0.1});
///     for (const auto& frame : frames)
///       plot(query.ask(frame.tool, frame.organ).distance.lower);
///
/// An answer depends on the positions of its own call alone. One thread at a time may use a RepeatedQuery,
/// and different ones are independent.
class GRAZE_API RepeatedQuery {
 public:
  /// Takes the two meshes and the settings. Copies of the meshes share what these hold, so the caller need
  /// not keep them. Throws Error for settings that query() refuses.
  RepeatedQuery(const Mesh& mesh_a, const Mesh& mesh_b, const QuerySettings& settings = {});
  /// Frees its memory and its result.
  ~RepeatedQuery();
  /// Takes the place of `other`, which may only be destroyed or assigned to afterwards.
  RepeatedQuery(RepeatedQuery&& other) noexcept;
  /// Takes the place of `other`, which may only be destroyed or assigned to afterwards.
  RepeatedQuery& operator=(RepeatedQuery&& other) noexcept;

  /// Answers as query() does. The result is valid until the next call. Throws Error for positions that
  /// query() refuses, and the result of the last call stays. After `std::bad_alloc` the object may only be
  /// destroyed or assigned to.
  const QueryResult& ask(PositionView positions_a, PositionView positions_b);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze
