#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <optional>

#include "core/surface/surface.hpp"
#include "objects/object_store.hpp"

namespace graze {

// How one object is brought to where it is now: from a pose, from a copy of positions, or from the caller's
// memory. ObjectStore decides when.

/// Whether there is something to be read, or the object is to be looked at for another reason.
[[nodiscard]] bool has_input(const Object& object);
/// Whether an object that a survey has seen has been told nothing since: it is where that found it.
[[nodiscard]] bool stays_unread(const Object& object);
/// Adds up what is promised of the motion since the surface's positions were read, this step's included.
void add_promise(Object& object);
/// Whether an object's box will do, unless that turns out to be near another: it was in no pair of the last
/// step or can be viewed, and nobody will ask how far it has moved. What stands still is read, which then
/// writes nothing, and so is what hardly moves, of which pairs have lists.
[[nodiscard]] bool can_be_surveyed(const Object& object, bool with_views);
/// Whether its box is known without a look at any vertex: from its pose, or since its positions were copied.
[[nodiscard]] bool has_known_box(const Object& object);
/// Whether its surface may look at what was surveyed in place of reading it.
[[nodiscard]] bool can_be_viewed(const Object& object);

/// What came of looking at all vertices.
struct ReadOutcome {
  bool to_write = false;  ///< all vertices, and then the read is to be finished
  bool changed = false;   ///< the object stands elsewhere, or has begun or ceased to be frozen
  std::optional<Diagnostic> problem;
  bool accepted = true;  ///< what was seen is where the object is
};

/// Reads or surveys an object. Its blocks are left to the caller, but for what is viewed.
ReadOutcome read_whole(Object& object);

// The same in parts: looks at some vertices, takes what was seen of all or says why not, writes some, and
// lets go of what was read after all was written. Bad memory is read again until it is good.
[[nodiscard]] Surface::PartSeen scan_part(const Object& object, std::uint32_t begin, std::uint32_t end);
ReadOutcome accept_scan(Object& object, const Surface::PartSeen& all);
void write_part(Object& object, std::uint32_t begin, std::uint32_t end);
void finish_read(Object& object, bool accepted);
/// Has the surface look at the memory that was surveyed, until the next read.
void view_memory(Object& object);

}  // namespace graze
