#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/settings.hpp>
#include <limits>
#include <memory>
#include <optional>

#include "base/access.hpp"
#include "base/spare_positions.hpp"
#include "core/base/box.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// The rows (r0, r1, r2, t) of a matrix.
using Pose = std::array<double, 12>;

/// One object of a scene, as steps see it.
struct Object {
  ObjectId id;
  std::uint64_t serial = 0;  ///< ascends in the order of addition; never reused
  ObjectSettings settings;
  std::unique_ptr<Surface> owned_surface;  ///< use the accessors below
  const IndexedMesh* mesh = nullptr;       ///< the surface's
  Box box;                    ///< contains the object: `seen`, grown by the motion promised since
  Box seen;                   ///< the box when the object was last read or surveyed
  bool has_surface = true;    ///< the surface has the positions that `seen` is of
  std::uint64_t version = 0;  ///< of the surface, after a read

  // The input of the next read, and the promises about its motion.
  std::optional<Pose> pose;
  std::optional<Pose> standing_pose;  ///< the last pose that was read or surveyed
  SparePositions::Loan positions;
  Box box_of_positions;                     ///< the box of `positions`
  SparePositions::Loan standing_positions;  ///< the copy that the surface uses
  std::optional<PositionView> bound;
  BindPolicy policy = BindPolicy::every_step;
  bool is_notified = false;
  std::uint64_t notified_step = 0;  ///< the last step before which `positions_changed` was called
  bool is_notified_again = false;   ///< `positions_changed` was called before the step before that, too
  bool is_new = false;              ///< input was given since the last step
  bool may_have_input = false;      ///< the store lists it for the next read
  double promise = std::numeric_limits<double>::infinity();
  /// The largest distance of any vertex from where the object was last read or surveyed, by the promises
  /// since. It is infinite before the first step, since promises count from where a step saw the object.
  double promised = std::numeric_limits<double>::infinity();
  /// The sum of the promises since `promised` was last 0, as the caller gave them, for messages.
  double promise_sum = 0;
  bool promises = false;  ///< the motion of the bound memory has been promised
  /// There are positions that have not been read, because promises or a survey show that they are far from
  /// everything.
  bool unread = false;
  bool wanted = false;  ///< listed for `read_unread`
  /// The unread positions were surveyed: `box` is their box, and the surface has the positions of the last
  /// read.
  bool surveyed = false;
  bool stays_unread = false;  ///< no call came since an earlier step surveyed it
  bool to_survey = false;     ///< the current read only surveys it
  bool moved = false;         ///< the last read found it moved, or it was bound since
  /// The object moves so little, judged by its box, that its exact motion is worth knowing (SlackOfMotion).
  /// It stays false for some steps after its vertices moved further than its box.
  bool is_nearly_static = false;
  std::uint8_t static_cooldown_steps = 0;
  bool tested = false;            ///< a pair of the last step tested it
  bool asked_for_blocks = false;  ///< a pair of the last step needs its blocks
  /// Pairs of the last step tested the object but none asked for blocks of its vertices, since they have
  /// lists.
  bool goes_by_lists = false;
  bool to_block = false;  ///< its blocks are made right after it is read, while its vertices are in a cache
  bool to_view = false;   ///< it was surveyed, and is viewed instead of read
  bool viewed = false;    ///< its surface views the bound memory, which may go after a step
  /// What the current refit has counted. If `refit` is another number, the counts are of an earlier refit.
  struct Asked {
    std::uint64_t refit = 0;
    std::size_t jobs = 0;  ///< jobs that test it
    bool walked = false;   ///< one of these jobs walked its regions in the last step
    double shares = 0;     ///< the shares of its box near the jobs' other objects; of large objects only
  } asked;
  /// The bound memory was bad when last read, or the last pose was refused. The object stays where it was,
  /// and its pairs are not tested.
  bool frozen = false;

  bool in_parts = false;          ///< it is large, so several tasks read and refit it
  bool removed = false;           ///< it is dropped before the next read
  std::size_t counted_bytes = 0;  ///< its part of ObjectStore::surface_bytes_

  [[nodiscard]] const Surface& surface() const {
    require_read(StepData::surfaces, this);
    return *owned_surface;
  }
  [[nodiscard]] Surface& surface_to_write() {
    require_write(StepData::surfaces, this);
    return *owned_surface;
  }
};

}  // namespace graze
