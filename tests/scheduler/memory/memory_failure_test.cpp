// A step that cannot get its memory throws, and leaves the last report published. The next step says what a
// scene built afresh says. Calls for which there is no memory throw or leave a diagnostic. Every allocation
// of a frame fails in turn, in eleven small scenes.
//
// By default each configuration takes every so many places only (GRAZE_FAILURE_STRIDE), from another one on
// than the others. With 1 in the environment variable of that name each takes all.

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <new>
#include <optional>

#include "scheduler/memory/failing_allocator.hpp"
#include "scheduler/memory/failure_scene.hpp"
#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"

namespace graze::tests {
namespace {

using Lack = FailingAllocator::Lack;

/// Played, and compared, after the one in which memory runs out.
constexpr std::size_t frames_after = 2;

std::uint64_t stride() {
  const char* const given = std::getenv("GRAZE_FAILURE_STRIDE");
  return given == nullptr ? 10'100 / repeats(100) : std::strtoull(given, nullptr, 10);
}

bool says_so(const FrameReport& report) {
  return std::any_of(
      report.diagnostics().begin(), report.diagnostics().end(),
      [](const Diagnostic& diagnostic) { return diagnostic.kind == DiagnosticKind::out_of_memory; });
}

/// Counts the failures of a test and how they ended.
struct Tally {
  std::uint64_t places = 0;
  std::uint64_t thrown_by_calls = 0;
  std::uint64_t thrown_by_steps = 0;
  std::uint64_t diagnostics = 0;
  std::uint64_t compared = 0;
};

/// One story with one detail and number of threads: its frames up to `event` are played, and then that one
/// without memory for some of it.
class Failures {
 public:
  Failures(const FailureScene& story, ContactDetail detail, unsigned threads, Tally& tally)
      : story_(story), settings_(story.settings(detail, threads)), tally_(tally) {}

  void fail_all(std::uint64_t first, std::uint64_t each, Lack lack) {
    for (std::uint64_t place = first; fail_at(place, lack); place += each) ++tally_.places;
  }

 private:
  const FreshReport& fresh(std::size_t frame) {
    auto& report = fresh_[frame];
    if (!report) report.emplace(story_, settings_, frame);
    return *report;
  }
  void compare(const FailurePlay& play, std::size_t frame, const FrameReport& report,
               const FrameReport& before) {
    const std::string difference = fresh(frame).difference_from(play, report, before);
    if (!difference.empty()) FAIL("frame " << frame << ": " << difference);
    ++tally_.compared;
  }

  /// False where the frame takes less than that.
  bool fail_at(std::uint64_t place, Lack lack) {
    CAPTURE(place);
    FailurePlay play(story_, settings_);
    ReportHandle last = play.scene().latest_report();
    for (std::size_t frame = 0; frame < story_.event(); ++frame) {
      play.tell(frame);
      last = play.step(frame);
    }
    bool call_has_thrown = false;
    bool step_has_thrown = false;
    ReportHandle report;
    FailingAllocator::begin(place, lack);
    try {
      play.tell(story_.event());
    } catch (const std::bad_alloc&) {
      call_has_thrown = true;
    }
    try {
      report = play.step(story_.event());
    } catch (const std::bad_alloc&) {
      step_has_thrown = true;
    } catch (const Error&) {
      step_has_thrown = true;
    }
    if (FailingAllocator::end() <= place) return false;
    tally_.thrown_by_calls += call_has_thrown ? 1 : 0;
    tally_.thrown_by_steps += step_has_thrown ? 1 : 0;
    if (play.scene().is_stepping()) FAIL("it says that it is stepping");
    const ReportHandle latest = play.scene().latest_report();
    bool has_said_so = false;
    if (step_has_thrown) {
      if (latest.get() != last.get()) FAIL("another report is the latest");
      if (place % 5 == 4) {  // the scene may go at once, and its reports stay
        play.end();
        if (!inconsistency_of(*last).empty()) FAIL("a report has changed");
        return true;
      }
    } else {
      if (latest.get() != report.get() || report->frame() != last->frame() + 1) FAIL("it is not the latest");
      if (!inconsistency_of(*report).empty()) FAIL(inconsistency_of(*report));
      has_said_so = says_so(*report);
      if (!has_said_so && !call_has_thrown) compare(play, story_.event(), *report, *last);
      last = report;
    }
    for (std::size_t frame = story_.event() + 1; frame <= story_.event() + frames_after; ++frame) {
      play.tell(frame);
      report = play.step(frame);
      if (report->frame() != last->frame() + 1) FAIL("frames do not follow one another");
      if (!inconsistency_of(*report).empty()) FAIL(inconsistency_of(*report));
      has_said_so = has_said_so || says_so(*report);
      compare(play, frame, *report, *last);
      last = report;
    }
    tally_.diagnostics += has_said_so ? 1 : 0;
    return true;
  }

  const FailureScene& story_;
  SceneSettings settings_;
  Tally& tally_;
  std::map<std::size_t, std::optional<FreshReport>> fresh_;
};

void fail_in(FailureStory story, std::size_t event, Lack lack, std::uint64_t each, Tally& tally) {
  const FailureScene scene(story, event);
  std::uint64_t configuration = static_cast<std::uint64_t>(story) + event;
  for (const ContactDetail detail : all_details)
    for (const unsigned threads : {1U, 2U}) {
      CAPTURE(event, static_cast<int>(detail), threads, static_cast<int>(lack));
      Failures(scene, detail, threads, tally).fail_all(configuration * 7 % each, each, lack);
      configuration += story_count;
    }
}

enum class Telling { copied, told, bound_anew };

/// A needle over a plate jumps before a step that fails at `place`, and moves a little, as promised, before
/// the next one, which must see it there. So many reports are held: a new one takes memory before a step
/// begins. Whether the step failed.
bool jump_and_promise(std::uint64_t place, std::size_t reports_held, Telling telling) {
  NeedleOverPlate pair(settings_of(0.5, 2, ContactDetail::vertices));
  Positions positions = lifted(*needle_mesh(), 90);
  const auto tell = [&](double height, double promise) {
    const Positions now = lifted(*needle_mesh(), height);
    std::copy(now.begin(), now.end(), positions.begin());
    if (telling == Telling::copied)
      pair.scene.set_positions(pair.needle, positions, promise);
    else
      pair.scene.positions_changed(pair.needle, promise);
  };
  if (telling != Telling::copied) pair.scene.bind_positions(pair.needle, positions, BindPolicy::when_told);
  tell(90, Scene::any_displacement);
  std::vector<ReportHandle> held{pair.scene.step()};
  while (held.size() < reports_held) held.push_back(pair.scene.step());
  if (telling == Telling::bound_anew) {
    pair.scene.unbind_positions(pair.needle);
    pair.scene.bind_positions(pair.needle, positions, BindPolicy::when_told);
  }
  tell(0.25, Scene::any_displacement);
  bool has_thrown = false;
  FailingAllocator::begin(place, Lack::from_then_on);
  try {
    (void)pair.scene.step();
  } catch (const std::bad_alloc&) {
    has_thrown = true;
  }
  (void)FailingAllocator::end();
  tell(0.125, 0.126);
  const ReportHandle report = pair.scene.step();
  const PairReport* const row = find_pair(*report, pair.plate, pair.needle);
  REQUIRE(row != nullptr);
  CHECK(row->distance.upper < 1);
  return has_thrown;
}

/// In the first frame of all, when everything is made, and in a later one. What fails is one allocation, or
/// all from it on until the frame ends.
void fail_in(FailureStory story) {
  Tally tally;
  for (const std::size_t event : {0U, 2U}) {
    fail_in(story, event, Lack::once, stride(), tally);
    fail_in(story, event, Lack::from_then_on, 2 * stride(), tally);
  }
  std::cout << tally.places << " places: " << tally.thrown_by_steps << " steps and " << tally.thrown_by_calls
            << " calls have thrown, " << tally.diagnostics << " calls left a diagnostic; " << tally.compared
            << " reports compared with a scene built afresh\n";
  CHECK(tally.thrown_by_steps > 0);
  CHECK(tally.compared > tally.places);
}

}  // namespace

TEST_CASE("memory failure: a promise counts from where a step has seen the object") {
  std::size_t thrown = 0;
  for (const Telling telling : {Telling::copied, Telling::told, Telling::bound_anew})
    for (std::size_t reports_held = 1; reports_held < 70; ++reports_held)
      for (std::uint64_t place = 0; place < 20; ++place) {
        CAPTURE(static_cast<int>(telling), reports_held, place);
        thrown += jump_and_promise(place, reports_held, telling) ? 1U : 0U;
      }
  CHECK(thrown > 500);
}

TEST_CASE("memory failure: a pose that could not be read is read by the next step") {
  const std::shared_ptr<const Mesh> mesh = mesh_of(models::sphere(10, 6));
  std::size_t thrown = 0;
  for (std::uint64_t place = 0; place < 60; ++place) {
    SceneSettings settings = settings_of(0.05, 1);
    settings.threads = 1;
    Scene scene(settings);
    ObjectSettings rigid;
    rigid.motion = Motion::rigid;
    const ObjectId body = scene.add(mesh, rigid);
    const Eigen::Isometry3d pose(Eigen::Translation3d(100, 0, 0));
    scene.set_pose(body, pose);
    scene.step();
    scene.step();
    // It is near the body, which is only surveyed so far, and lets it take part in sweeps.
    ObjectSettings swept;
    swept.swept = true;
    scene.set_positions(scene.add(mesh, swept), moved(mesh->rest(), {102.5, 0, 0}));
    FailingAllocator::begin(place, FailingAllocator::Lack::once);
    try {
      scene.step();
    } catch (const std::bad_alloc&) {
      ++thrown;
    }
    FailingAllocator::end();
    scene.set_pose(body, pose);
    const ReportHandle report = scene.step();
    CAPTURE(place);
    REQUIRE(report->pairs().size() == 1);
    CHECK(report->pairs()[0].distance.upper < 0.6);
  }
  CHECK(thrown > 5);
}

TEST_CASE("memory failure: positions are copied") {
  fail_in(FailureStory::copied);
}

TEST_CASE("memory failure: memory is bound, and freed when its binding ends") {
  fail_in(FailureStory::bound);
}

TEST_CASE("memory failure: bound memory is read when told") {
  fail_in(FailureStory::told);
}

TEST_CASE("memory failure: rigid bodies over a fixed one") {
  fail_in(FailureStory::posed);
}

TEST_CASE("memory failure: bodies come and go") {
  fail_in(FailureStory::come_and_go);
}

TEST_CASE("memory failure: pairs and rules change, and calls are bad") {
  fail_in(FailureStory::filters);
}

TEST_CASE("memory failure: room is reserved, and reports are held") {
  fail_in(FailureStory::reserved);
}

TEST_CASE("memory failure: a pair of large surfaces, and distances of regions") {
  fail_in(FailureStory::large);
}

TEST_CASE("memory failure: step_async") {
  fail_in(FailureStory::async);
}

TEST_CASE("memory failure: meshes are replaced") {
  fail_in(FailureStory::replaced);
}

TEST_CASE("memory failure: budgets") {
  fail_in(FailureStory::budgets);
}

}  // namespace graze::tests
