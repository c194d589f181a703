#include "calls.hpp"
#include "handles.hpp"
#include "settings.hpp"

using graze::c::given;
using graze::c::guarded;

namespace {

/// Returns the caller's settings with those that it does not have, or the default ones for null.
graze_recorder_settings all_settings(const graze_recorder_settings* settings) {
  const graze_recorder_settings defaults = graze::c::default_recorder_settings();
  const graze_recorder_settings all =
      settings == nullptr ? defaults : graze::c::whole(*settings, defaults, "settings");
  if (all.when_behind > GRAZE_WAIT)
    throw graze::c::BadArgument("when_behind is " + std::to_string(all.when_behind) +
                                ", which is no enumerator");
  return all;
}

static_assert(
    graze::c::has_members<graze::RecorderStatistics, &graze::RecorderStatistics::frames,
                          &graze::RecorderStatistics::dropped, &graze::RecorderStatistics::bytes>());
graze_recorder_statistics described(const graze::RecorderStatistics& statistics) {
  return {statistics.frames, statistics.dropped, statistics.bytes};
}

}  // namespace

extern "C" {

graze_status graze_recorder_new(graze_scene* scene, const char* file, const graze_recorder_settings* settings,
                                graze_recorder** recorder) {
  return guarded([&] {
    auto& room = given(recorder, "recorder");
    room = new graze_recorder{graze::Recorder(given(scene, "scene").scene, &given(file, "file"),
                                              graze::c::recorder_settings_from_c(all_settings(settings)))};
  });
}

graze_status graze_recorder_new_ring(graze_scene* scene, const graze_recorder_settings* settings,
                                     graze_recorder** recorder) {
  return guarded([&] {
    auto& room = given(recorder, "recorder");
    const graze_recorder_settings all = all_settings(settings);
    room =
        new graze_recorder{graze::Recorder(given(scene, "scene").scene, graze::c::ring_settings_from_c(all),
                                           graze::c::recorder_settings_from_c(all))};
  });
}

graze_status graze_recorder_close(graze_recorder* recorder) {
  return guarded([&] { given(recorder, "recorder").recorder.close(); });
}

graze_status graze_recorder_write(graze_recorder* recorder, const char* file,
                                  graze_recorder_statistics* statistics) {
  return guarded([&] {
    const auto written = given(recorder, "recorder").recorder.write(&given(file, "file"));
    if (statistics != nullptr) *statistics = described(written);
  });
}

graze_status graze_recorder_get_statistics(const graze_recorder* recorder,
                                           graze_recorder_statistics* statistics) {
  return guarded([&] {
    given(statistics, "statistics") = described(given(recorder, "recorder").recorder.statistics());
  });
}

void graze_recorder_release(graze_recorder* recorder) {
  delete recorder;
}

}  // extern "C"
