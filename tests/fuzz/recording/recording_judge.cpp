#include "fuzz/recording/recording_judge.hpp"

#include <graze/error.hpp>
#include <graze/recording.hpp>
#include <stdexcept>
#include <vector>

#include "fuzz/recording/made_recording.hpp"

namespace graze::fuzz {
namespace {

void expect_that(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error(what);
}

/// Whether `work` does what it does. What it may do instead is to throw an Error of one line. Other
/// exceptions get through.
template <typename Work>
bool is_done(const Work& work) {
  try {
    work();
    return true;
  } catch (const Error& error) {
    const std::string message = error.what();
    expect_that(!message.empty(), "a refusal without a word");
    expect_that(message.find_first_of("\r\n") == std::string::npos, "a refusal of several lines: " + message);
    return false;
  }
}

/// Whether a diagnostic says that the scene did not take up a call.
bool says_refused(const Diagnostic& diagnostic) {
  switch (diagnostic.kind) {
    case DiagnosticKind::not_finite:
    case DiagnosticKind::too_large:
      return diagnostic.message.find("the old positions stand") != std::string::npos;
    case DiagnosticKind::broken_promise:
      return diagnostic.message.find("negative or NaN") != std::string::npos;
    default:
      return true;
  }
}

void expect_taken(const FrameReport& report) {
  for (const Diagnostic& diagnostic : report.diagnostics())
    expect_that(diagnostic.message == made_message || !says_refused(diagnostic),
                "the scene refused a call of the recording: " + diagnostic.message);
}

void replay(const Recording& recording, std::size_t first_frame, bool made) {
  Replay replay(recording, {.threads = 1, .first_frame = first_frame});
  std::vector<Eigen::Vector3d> positions;
  while (replay.step()) {
    if (made) expect_taken(*replay.report());
    for (std::size_t i = 0; i < replay.objects().size(); ++i) {
      replay.read_positions(i, positions);
      (void)replay.pose(i);
      expect_that(positions.size() == replay.objects()[i].mesh->vertex_count(),
                  "positions are not one for each vertex");
    }
  }
}

/// Scenes that would take long or much memory say nothing new.
bool is_small(const Recording& recording) {
  return recording.frame_count() <= 16 && recording.settings().region_distances <= 4096;
}

void judge_part(const Recording& recording, const RecordingPart& wanted, const std::filesystem::path& path,
                bool made) {
  if (!is_done([&] { cut_recording(recording, wanted, path); })) return;
  const bool is_good = is_done([&] {
    const Recording part(path);
    part.check();
    replay(part, 0, made);
  });
  expect_that(is_good || !made, "a part is not replayed");
}

void judge(const Recording& recording, const std::filesystem::path& folder, bool made) {
  const bool is_good = is_done([&] { recording.check(); });
  if (recording.frame_count() == 0 || !is_small(recording)) return;
  const std::size_t count = recording.frame_count();
  (void)is_done([&] {
    for (std::size_t frame = 0; frame < count; ++frame) (void)recording.frame(frame);
  });
  const bool is_replayed = is_done([&] { replay(recording, 0, made); });
  if (made) expect_that(is_good == is_replayed, "the check passes and the replay does not, or the other way");
  (void)is_done([&] { replay(recording, count - 1, made); });
  judge_part(recording, {.first_frame = count / 2, .objects = {0, 1}}, folder / "part.graze", made);
  judge_part(recording, {.first_frame = count - 1}, folder / "part.graze", made);
}

}  // namespace

std::string problem_of_recording(const std::filesystem::path& path, const std::filesystem::path& folder,
                                 bool made) {
  try {
    (void)is_done([&] { judge(Recording(path), folder, made); });
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace graze::fuzz
