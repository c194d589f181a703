#include <limits>

#include "calls.hpp"
#include "handles.hpp"
#include "settings.hpp"

using graze::c::BadArgument;
using graze::c::given;
using graze::c::guarded;

namespace {

const graze::Recording& recording_of(const graze_recording* recording) {
  return *given(recording, "recording").recording;
}

static_assert(
    graze::c::has_members<graze::RecordedFrame, &graze::RecordedFrame::frame, &graze::RecordedFrame::tag,
                          &graze::RecordedFrame::pairs, &graze::RecordedFrame::pairs_in_contact,
                          &graze::RecordedFrame::contacts, &graze::RecordedFrame::diagnostics,
                          &graze::RecordedFrame::dropped_before, &graze::RecordedFrame::has_keyframe,
                          &graze::RecordedFrame::complete, &graze::RecordedFrame::step_ms>());

}  // namespace

extern "C" {

graze_status graze_recording_open(const char* file, graze_recording** recording) {
  return guarded([&] {
    auto& room = given(recording, "recording");
    room = new graze_recording{std::make_shared<const graze::Recording>(&given(file, "file"))};
  });
}

void graze_recording_release(graze_recording* recording) {
  delete recording;
}

graze_status graze_recording_settings(const graze_recording* recording, graze_scene_settings* settings) {
  return guarded([&] {
    graze::c::fill(settings, given(settings, "settings").struct_size,
                   graze::c::to_c(recording_of(recording).settings()), "settings");
  });
}

const char* graze_recording_made_by(const graze_recording* recording) {
  return recording ? recording->recording->made_by().c_str() : nullptr;
}

bool graze_recording_is_finished(const graze_recording* recording) {
  return recording != nullptr && recording->recording->is_finished();
}

bool graze_recording_is_cut(const graze_recording* recording) {
  return recording != nullptr && recording->recording->is_cut();
}

size_t graze_recording_frame_count(const graze_recording* recording) {
  return recording ? recording->recording->frame_count() : 0;
}

graze_status graze_recording_frame(const graze_recording* recording, size_t index,
                                   graze_recorded_frame* frame) {
  return guarded([&] {
    const graze::Recording& read = recording_of(recording);
    auto& room = given(frame, "frame");
    if (index >= read.frame_count())
      throw BadArgument("index is " + std::to_string(index) + " of " + std::to_string(read.frame_count()));
    const graze::RecordedFrame found = read.frame(index);
    room = {found.frame,    found.tag,         found.pairs,          found.pairs_in_contact,
            found.contacts, found.diagnostics, found.dropped_before, found.has_keyframe,
            found.complete, found.step_ms};
  });
}

uint64_t graze_recording_dropped_at_end(const graze_recording* recording) {
  return recording ? recording->recording->dropped_at_end() : 0;
}

size_t graze_recording_mesh_count(const graze_recording* recording) {
  return recording ? recording->recording->mesh_count() : 0;
}

uint64_t graze_recording_byte_count(const graze_recording* recording) {
  return recording ? recording->recording->byte_count() : 0;
}

graze_status graze_recording_check(const graze_recording* recording) {
  return guarded([&] { recording_of(recording).check(); });
}

graze_status graze_recording_cut(const graze_recording* recording, size_t first_frame, size_t last_frame,
                                 const uint64_t* serials, size_t serial_count, const char* file) {
  return guarded([&] {
    const auto kept = graze::c::array(serials, serial_count, "serials");
    graze::cut_recording(
        recording_of(recording),
        {.first_frame = first_frame, .last_frame = last_frame, .objects = {kept.begin(), kept.end()}},
        &given(file, "file"));
  });
}

}  // extern "C"
