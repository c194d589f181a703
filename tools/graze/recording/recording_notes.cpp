#include "recording/recording_notes.hpp"

#include "output/terminal.hpp"

namespace graze::tools {

std::string unfinished_text(const Recording& recording) {
  return recording.is_finished() ? "" : ", not finished";
}

void note_unfinished(const Recording& recording, const std::string& file) {
  if (!recording.is_finished())
    say_aside("note", file +
                          " is not finished: the program that recorded it ended before, and it is read up to "
                          "its last whole frame");
}

void note_divergence(const SnapshotReader& reader, const std::string& file) {
  if (!reader.is_as_recorded())
    say_aside("note", "the replay differs from the recording; graze replay " + file + " says where");
}

void RowsLeftOut::add(const Replay& replay) {
  not_compared_ += replay.rows_not_compared();
  in_part_ += replay.rows_compared_in_part();
}

void RowsLeftOut::print() const {
  constexpr const char* reason = "depend on earlier frames, on other pairs or on the clock";
  if (not_compared_ > 0) say("not compared: %zu rows that %s\n", not_compared_, reason);
  if (in_part_ > 0)
    say("compared in part: %zu rows whose bounds, contacts or lines of regions %s\n", in_part_, reason);
}

std::string RowsLeftOut::reservation() const {
  return not_compared_ + in_part_ > 0 ? " as far as they can be compared" : "";
}

}  // namespace graze::tools
