#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <optional>

#include "core/surface/surface.hpp"
#include "objects/object.hpp"

namespace graze {

// Functions that move one object's surface to its current positions: from a pose, from copied positions, or
// from the caller's memory. ObjectStore decides when.

/// Whether the object has something to read, or has to be processed in this read for another reason.
[[nodiscard]] bool has_input(const Object& object);
/// Whether a surveyed object has received no call since its survey, so that it is where the survey found it.
[[nodiscard]] bool stays_unread(const Object& object);
/// Adds this step's promise to the motion promised since the surface's positions were read.
void add_promise(Object& object);
/// Whether an object may be surveyed instead of read. It may if no pair tested it in the last step, or if it
/// can be viewed. Objects that stand still are read, which writes nothing. So are nearly static objects,
/// since their pairs have lists. So are those in swept pairs, since the next step needs their positions.
[[nodiscard]] bool can_be_surveyed(const Object& object, bool with_views);
/// Whether the object's box is known without reading a vertex: from its pose, or from copying its positions.
[[nodiscard]] bool has_known_box(const Object& object);
/// Whether the surface may view the surveyed memory instead of copying it.
[[nodiscard]] bool can_be_viewed(const Object& object);

/// The result of reading or surveying all vertices of an object.
struct ReadOutcome {
  bool to_write = false;  ///< all vertices have to be written before `finish_read`
  bool changed = false;   ///< the object has moved, or has become frozen or live
  std::optional<Diagnostic> problem;
  bool accepted = true;  ///< the object is at the positions that were read
};

/// Places a posed object at its pose now.
void settle_pose(Object& object);
/// Reads or surveys an object. The caller makes its blocks, except those of a viewed object.
ReadOutcome read_whole(Object& object);

// Functions that read an object in parts. `scan_part` reads some vertices. `accept_scan` accepts the results
// of all parts or says why not. `write_part` writes some vertices, and `finish_read` releases the input once
// all are written. Bad memory is read again in every step until it is good.
[[nodiscard]] Surface::PartSeen scan_part(const Object& object, std::uint32_t begin, std::uint32_t end);
ReadOutcome accept_scan(Object& object, const Surface::PartSeen& all);
void write_part(Object& object, std::uint32_t begin, std::uint32_t end);
void finish_read(Object& object, bool accepted);
/// Makes the surface view the surveyed memory until the next read.
void view_memory(Object& object);

}  // namespace graze
