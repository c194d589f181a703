// Reports: numbered, flat, immutable, and alive as long as a handle is.

#include <atomic>
#include <optional>
#include <thread>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

/// The height of step `index`: in and out of contact and range.
double height_of(std::size_t index) {
  return static_cast<double>(index * 5 % 13) / 8;
}

}  // namespace

TEST_CASE("before the first step there is an empty report of frame 0") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  pair.scene.remove({});
  const ReportHandle report = pair.scene.latest_report();
  REQUIRE(report);
  CHECK(report->frame() == 0);
  CHECK(report->pairs().empty());
  CHECK(report->contacts().empty());
  CHECK(report->diagnostics().empty());
  CHECK(report->complete());
  pair.scene.step();
  CHECK(report->frame() == 0);
  CHECK(report->pairs().empty());
}

TEST_CASE("frames count from 1, and the latest report is that of the last step") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  for (std::uint64_t frame = 1; frame < 20; ++frame) {
    const ReportHandle report = pair.step_at(height_of(frame));
    CHECK(report->frame() == frame);
    CHECK(pair.scene.latest_report().get() == report.get());
  }
}

TEST_CASE("an empty scene steps") {
  Scene scene;
  const ReportHandle report = scene.step();
  CHECK(report->frame() == 1);
  CHECK(report->pairs().empty());
  CHECK(report->statistics().pairs_total == 0);
  CHECK(scene.object_count() == 0);
}

TEST_CASE("hundreds of handles keep their reports as they were, also after the scene") {
  std::vector<ReportHandle> handles;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> diagnostics;
  {
    NeedleOverPlate pair(settings_of(0.5, 1));
    for (std::size_t i = 0; i < 400; ++i) {
      if (i % 7 == 0) pair.scene.remove({});
      handles.push_back(pair.step_at(height_of(i)));
      if (i % 3 == 0) handles.back() = pair.scene.latest_report();
      rows.push_back(rows_of(*handles.back()));
      diagnostics.push_back(handles.back()->diagnostics().size());
      if (i % 5 == 4) handles[i - 2] = ReportHandle();  // let go on the way
    }
  }
  std::size_t with_contacts = 0;
  for (std::size_t i = 0; i < handles.size(); ++i) {
    if (!handles[i]) continue;
    REQUIRE(handles[i]->frame() == i + 1);
    REQUIRE(rows_of(*handles[i]) == rows[i]);
    REQUIRE(handles[i]->diagnostics().size() == diagnostics[i]);
    with_contacts += handles[i]->contacts().empty() ? 0U : 1U;
  }
  CHECK(with_contacts > 50);
}

TEST_CASE("handles are copied, moved and assigned") {
  std::optional<NeedleOverPlate> pair;
  pair.emplace(settings_of(0.5, 1));
  const ReportHandle first = pair->step_at(0.25);
  const auto rows = rows_of(*first);
  ReportHandle copy = first;
  CHECK(copy.get() == first.get());
  ReportHandle stolen = std::move(copy);
  CHECK(stolen.get() == first.get());
  CHECK(copy.get() == nullptr);  // NOLINT(bugprone-use-after-move): a moved handle holds nothing
  ReportHandle other = pair->step_at(2);
  CHECK(other->frame() == 2);
  other = stolen;
  CHECK(other.get() == first.get());
  ReportHandle& same = other;
  other = same;
  CHECK(other.get() == first.get());
  stolen = ReportHandle();
  CHECK_FALSE(stolen);
  for (std::size_t i = 0; i < 100; ++i) pair->step_at(height_of(i));
  pair.reset();
  CHECK(rows_of(*other) == rows);
  CHECK(rows_of(*first) == rows);
}

TEST_CASE("handles of one report live on several threads, beyond the scene") {
  std::optional<NeedleOverPlate> pair;
  pair.emplace(settings_of(0.5, 1));
  const ReportHandle report = pair->step_at(0.25);
  const auto rows = rows_of(*report);
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&wrong, &rows, own = report] {
      std::vector<ReportHandle> many;
      for (int round = 0; round < 200; ++round) {
        many.push_back(round % 2 == 0 ? own : many.back());
        ReportHandle taken = std::move(many[static_cast<std::size_t>(round) / 2]);
        if (rows_of(*taken) != rows) ++wrong;
        many[static_cast<std::size_t>(round) / 2] = std::move(taken);
      }
    });
  for (std::size_t i = 0; i < 50; ++i) pair->step_at(height_of(i));
  pair.reset();
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
  CHECK(rows_of(*report) == rows);
}

TEST_CASE("the contacts of a report are one flat array in the order of pairs, each pair's a span of it") {
  Scene scene(settings_of(0.75, 4));
  const auto torus = mesh_of(models::torus(8, 6, 1, 0.25));
  for (int i = 0; i < 5; ++i) scene.set_positions(scene.add(torus), lifted(*torus, 0.875 * i));
  const ReportHandle report = scene.step();
  CHECK(report->pairs().size() == 10);
  std::size_t next = 0;
  for (const PairReport& pair : report->pairs()) {
    const auto contacts = report->contacts(pair);
    CHECK(contacts.data() == report->contacts().data() + next);
    next += contacts.size();
  }
  CHECK(next == report->contacts().size());
  CHECK(next > 100);
  CHECK(inconsistency_of(*report) == "");
  CHECK(report->statistics().contacts == next);
  CHECK(report->statistics().pairs_near == 10);
  CHECK(report->statistics().pairs_in_contact == 4);
  CHECK(report->statistics().objects == 5);
  CHECK(report->statistics().bytes.objects > 5 * torus->vertex_count() * sizeof(Eigen::Vector3d));
  CHECK(report->statistics().bytes.reports >= next * sizeof(Contact));
}

TEST_CASE("a scene that is moved goes on") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  pair.step_at(0.25);
  Scene moved_scene = std::move(pair.scene);
  const ReportHandle report = moved_scene.step();
  CHECK(report->frame() == 2);
  CHECK(only_pair(*report).phase == PairPhase::touching);
  pair.scene = Scene(settings_of(0, 0));
  CHECK(pair.scene.step()->frame() == 1);
}

}  // namespace graze::tests
