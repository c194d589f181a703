#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <memory>
#include <optional>
#include <span>

namespace graze {

/// @addtogroup report
/// @{

/// Two objects that are in contact, as Patch::contacts() finds them. One of them is the tool.
struct PatchPair {
  /// The object of the pair that was added first.
  ObjectId a;
  /// The object of the pair that was added last.
  ObjectId b;
  /// Whether one object is inside the other, if one of them is a solid.
  Inside inside = Inside::none;
  /// The index of the pair's first contact in PatchRoom::contacts().
  std::size_t first_contact = 0;
  /// The number of contacts of the pair.
  std::size_t contact_count = 0;
};

/// Says what the contacts that Patch::contacts() has found are worth.
struct PatchAnswer {
  /// Whether all contacts are listed. It is false if a face that is not in the patch could be nearer than the
  /// threshold.
  bool complete = false;
  /// The threshold up to which all contacts are listed: what was asked, or less if #complete is false. Below
  /// 0 nothing is known, and nothing is listed.
  double threshold = 0;
  /// How much further tool and tissue together may travel until a face that is not in the patch could be
  /// nearer than what was asked. It is 0 if #complete is false.
  double validity = 0;
};

/// The caller's room for the contacts of a patch, with the memory that the search works in. One thread at a
/// time may use a room, for any patches. It keeps its memory. So a call takes memory only if it needs more
/// than all calls before, or if the tool has another mesh.
class GRAZE_API PatchRoom {
 public:
  /// Makes a room that has no memory yet. Throws `std::bad_alloc`.
  PatchRoom();
  ~PatchRoom();  ///< Frees its memory.
  /// Takes what `other` holds. `other` must not be used any more.
  PatchRoom(PatchRoom&& other) noexcept;
  /// Takes what `other` holds. `other` must not be used any more.
  PatchRoom& operator=(PatchRoom&& other) noexcept;

  /// Returns the pairs that the last call of Patch::contacts() found in contact. They are sorted by the order
  /// in which a, then b, were added.
  [[nodiscard]] std::span<const PatchPair> pairs() const;
  /// Returns the contacts of all these pairs, in their order. Those of a pair are sorted by kind, feature a,
  /// feature b. Contact::since is 0.
  [[nodiscard]] std::span<const Contact> contacts() const;
  /// Returns the contacts of one of these pairs.
  [[nodiscard]] std::span<const Contact> contacts(const PatchPair& pair) const {
    return contacts().subspan(pair.first_contact, pair.contact_count);
  }

 private:
  friend class Patch;
  struct State;
  std::unique_ptr<State> state_;
};

/// @cond internal
struct KeptPatch;
/// @endcond

/// Knows what lies around a tool in one step, for answers between steps: the faces of other objects within a
/// radius of the tool, where that step saw them. FrameReport::patch() gives it, for an object that has
/// ObjectSettings::patch_radius.
///
/// A patch is good for as long as the report, or a copy of it. Any number of threads may ask it at the same
/// time, each with a PatchRoom of its own. It waits for nothing and takes no lock.
///
/// Faces are there by leaves of the octree of their mesh. So some that are a little further away are there as
/// well. Of an object with ObjectSettings::solid all is there, since all of its faces decide what is inside.
/// Objects are left out as they are for pairs: by layers, by groups of objects, and if they are ignored.
/// Groups of faces that are hidden or ignored count as in that step. SceneSettings::ways_out and limits of
/// contacts do not count.
///
/// A frozen object is there where the last good input put it. Where the scene does not have those positions
/// any more, the radius ends before the object. If the tool is such an object, its patch knows nothing.
class GRAZE_API Patch {
 public:
  /// An empty patch, which knows nothing.
  Patch() = default;

  /// Returns true unless the patch is empty.
  [[nodiscard]] explicit operator bool() const { return kept_ != nullptr; }
  /// Returns the object whose patch it is. It is a default id for an empty patch.
  [[nodiscard]] ObjectId tool() const;
  /// Returns the radius within which all faces are there, as far as the tool was where the step saw it. It is
  /// ObjectSettings::patch_radius, or less if the patch #is_cut, or where a frozen object is.
  [[nodiscard]] double radius() const;
  /// Returns whether ObjectSettings::patch_faces made the radius smaller.
  [[nodiscard]] bool is_cut() const;
  /// Returns the number of faces that are there for this tool, of all objects together.
  [[nodiscard]] std::size_t face_count() const;
  /// Returns the objects that have faces there, in the order in which they were added.
  [[nodiscard]] std::span<const ObjectId> objects() const;
  /// Returns the faces of an object that are there for this tool, by their numbers in the mesh, ascending.
  /// FrameReport::mesh() has the mesh. It is empty for an object that is not there.
  [[nodiscard]] std::span<const std::uint32_t> faces(ObjectId object) const;
  /// Returns the positions of an object's vertices, of which those of faces() mean something. It is empty for
  /// an object that is not there.
  [[nodiscard]] PositionView positions(ObjectId object) const;

  /// Fills `room` with the contacts between the tool and the patch, if the tool were at a pose. They are
  /// those of ContactDetail::nearest, bit for bit as a scene would list them. In that scene all others stand
  /// where the step saw them, and every pair has this threshold.
  ///
  /// The tool is posed as Scene::set_pose() does it. `threshold` is in the caller's units, finite, and 0 or
  /// more. Margins and rules are not added to it. Where the answer is not complete, the contacts are those
  /// of PatchAnswer::threshold. An empty patch has none.
  ///
  /// Throws Error if the matrix is no rotation within 1e-3, or not finite, and for a threshold that is not
  /// allowed. Then `room` holds nothing. Throws `std::bad_alloc` if the room has to grow and cannot.
  PatchAnswer contacts(const Eigen::Isometry3d& pose, double threshold, PatchRoom& room) const;
  /// Fills `room` for a tool whose vertices are at other positions. Throws Error if there are not as many as
  /// the mesh of the tool has vertices. It also does so if one that a face uses is not finite or beyond
  /// 2^120.
  PatchAnswer contacts(PositionView positions, double threshold, PatchRoom& room) const;

  /// Returns how much further tool and tissue together may travel until a face that is not in the patch could
  /// be nearer than a threshold, if the tool were at a pose. It is in the caller's units, and at least 0. It
  /// is 0, too, where the answer is not complete any more.
  ///
  /// Without a threshold it is the largest that the scene has for a pair of the tool. The tool travels as
  /// far as its vertex that travels furthest. Takes no memory. Throws Error as contacts() does.
  [[nodiscard]] double validity(const Eigen::Isometry3d& pose,
                                std::optional<double> threshold = std::nullopt) const;
  /// Returns the same for a tool whose vertices are at other positions.
  [[nodiscard]] double validity(PositionView positions, std::optional<double> threshold = std::nullopt) const;

 private:
  friend class FrameReport;
  explicit Patch(const KeptPatch* kept) : kept_(kept) {}

  const KeptPatch* kept_ = nullptr;
};

/// @}

}  // namespace graze
