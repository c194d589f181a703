// Budgets: what is left undone is said, bounds hold, and a budget of work gives the same answer every time.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "scheduler/moving_scene.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// A stack of tori: the lower two in contact, the others further and further apart.
struct Stack {
  explicit Stack(const SceneSettings& settings) : scene(settings) {
    for (std::size_t i = 0; i < heights.size(); ++i) {
      ids.push_back(scene.add(mesh));
      scene.set_positions(ids.back(), lifted(*mesh, heights[i]));
    }
  }
  std::shared_ptr<const Mesh> mesh = mesh_of(models::torus(24, 10, 1, 0.25));
  std::array<double, 4> heights = {3, 0, 1.125, 0.53125};
  Scene scene;
  std::vector<ObjectId> ids;
};

/// Processor time of the calling thread, in units of CLOCKS_PER_SEC.
std::clock_t cpu_time_now() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * CLOCKS_PER_SEC + now.tv_nsec / (1'000'000'000 / CLOCKS_PER_SEC);
}

void check_undone(const FrameReport& report) {
  CHECK_FALSE(report.complete());
  CHECK(report.contacts().empty());
  CHECK(inconsistency_of(report) == "");
  for (const PairReport& pair : report.pairs()) {
    CHECK_FALSE(pair.complete);
    CHECK_FALSE(pair.stale);
  }
}

}  // namespace

TEST_CASE("in no time everything is read, bounded and left undone") {
  for (const unsigned threads : {1U, 2U})
    for (const ContactDetail detail : all_details)
      for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const oracle::RandomScene given = oracle::random_scene(seed);
        SceneSettings settings = settings_of(given.threshold, 100, detail);
        settings.threads = threads;
        settings.time_budget = std::chrono::microseconds(0);
        Scene scene(settings);
        const ObjectId a = scene.add(mesh_of(given.b));
        scene.add(mesh_of(given.b));
        scene.set_positions(a, mesh_of(given.b)->rest());
        const ObjectId moved_object = scene.add(mesh_of(given.a));
        const ReportHandle report = scene.step();
        REQUIRE(report->pairs().size() == 3);
        check_undone(*report);
        const PairReport* const pair = find_pair(*report, a, moved_object);
        REQUIRE(pair->phase == PairPhase::near);
        const bool vertices = detail == ContactDetail::regions || detail == ContactDetail::vertices;
        const oracle::Pair truth =
            vertices ? oracle::vertex_distance(given.b, given.a) : oracle::surface_distance(given.b, given.a);
        REQUIRE(pair->distance.lower <= truth.distance_down);
        REQUIRE(pair->distance.upper >= truth.distance_up);
        REQUIRE((pair->witness.point_b - pair->witness.point_a).norm() ==
                Approx(pair->distance.upper).epsilon(1e-12));
      }
}

TEST_CASE("positions are read in no time") {
  SceneSettings settings = settings_of(0.5, 100);
  settings.time_budget = std::chrono::microseconds(0);
  NeedleOverPlate pair(settings);
  for (const double height : {50.0, 7.0, 80.0}) {
    const ReportHandle report = pair.step_at(height);
    const PairReport& row = only_pair(*report);
    CHECK(row.distance.lower <= height);
    CHECK(row.distance.lower > height - 1e-9);  // a box above a box
    CHECK(row.distance.upper >= height);
    CHECK(row.distance.upper < height + 6);
  }
}

TEST_CASE("with time enough everything is done") {
  for (const auto budget :
       {std::chrono::microseconds(std::chrono::hours(1)), std::chrono::microseconds::max()}) {
    SceneSettings settings = settings_of(0.125, 2);
    const ReportHandle expected = Stack(settings).scene.step();
    settings.time_budget = budget;
    const ReportHandle report = Stack(settings).scene.step();
    CHECK(report->complete());
    CHECK(difference_of(*report, *expected) == "");
  }
}

TEST_CASE("a time budget holds where everything is in contact, and what it leaves out is said") {
  // Without a look at the clock in the midst of a pair these steps take 20 to 5,000 ms. Processor time of
  // this thread counts, and the longest steps do not: memory that is new costs as much as the machine says.
  constexpr double budget_ms = 2;
  constexpr double allowed_ms = 12;
  constexpr std::size_t steps = 12;
  const auto mesh = mesh_of(models::sphere(60, 40));
  for (const unsigned threads : {1U, 2U})
    for (const ContactDetail detail : all_details) {
      SceneSettings settings = settings_of(0.5, 0.5, detail);
      settings.threads = threads;
      settings.time_budget = std::chrono::microseconds(static_cast<std::int64_t>(budget_ms * 1000));
      Scene scene(settings);
      // The first two in one place.
      std::array<ObjectId, 3> ids;
      for (ObjectId& id : ids) id = scene.add(mesh);
      std::vector<double> taken_ms;
      for (std::size_t step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < ids.size(); ++i) {
          const double by = 0.001 * static_cast<double>(step) + (i == 2 ? 0.1 : 0);
          scene.set_positions(ids[i], moved(mesh->rest(), {by, 0, 0}));
        }
        const std::clock_t start = cpu_time_now();
        const ReportHandle report = scene.step();
        taken_ms.push_back(1e3 * static_cast<double>(cpu_time_now() - start) / CLOCKS_PER_SEC);
        CHECK(inconsistency_of(*report) == "");
        bool all = true;
        for (const PairReport& pair : report->pairs()) {
          all = all && pair.complete;
          if (pair.complete) continue;
          CHECK(pair.contact_count == 0);
          // Spheres in one place, or a tenth of their radius apart.
          CHECK(pair.distance.lower == 0);
          CHECK((pair.witness.point_b - pair.witness.point_a).norm() ==
                Approx(pair.distance.upper).epsilon(1e-12).margin(1e-12));
        }
        CHECK(report->complete() == all);
      }
      std::sort(taken_ms.begin(), taken_ms.end());
      INFO("detail " << static_cast<int>(detail) << ", " << threads << " threads");
      CHECK(taken_ms[steps - 4] < allowed_ms);
    }
}

TEST_CASE("a negative budget is refused") {
  SceneSettings settings = settings_of(0.125, 2);
  settings.time_budget = std::chrono::microseconds(-1);
  CHECK_THROWS_AS(Scene(settings), Error);
}

TEST_CASE("a work budget is the same in every run and for any number of threads") {
  const MovingScene moving;
  for (const ContactDetail detail : all_details)
    for (const std::uint64_t budget : {std::uint64_t{0}, std::uint64_t{7}, std::uint64_t{60}}) {
      SceneSettings settings = settings_of(0.05, 0.25, detail);
      settings.work_budget = budget;
      const auto expected = moving.play(settings, 12);
      bool incomplete = false;
      for (const unsigned threads : {1U, 2U, 5U}) {
        settings.threads = threads;
        const auto found = moving.play(settings, 12);
        for (std::size_t frame = 0; frame < found.size(); ++frame) {
          REQUIRE(difference_of(*found[frame], *expected[frame]) == "");
          REQUIRE(inconsistency_of(*found[frame]) == "");
          REQUIRE(found[frame]->statistics().work.region_pairs_tested <= budget);
          incomplete = incomplete || !found[frame]->complete();
          if (budget == 0) check_undone(*found[frame]);
        }
      }
      CHECK(incomplete);
    }
}

TEST_CASE("what a work budget leaves done is exact, and the bounds of the rest hold") {
  const MovingScene moving;
  for (const ContactDetail detail : all_details) {
    SceneSettings settings = settings_of(0.05, 0.25, detail);
    std::size_t done = 0;
    std::size_t undone = 0;
    for (std::size_t frame = 0; frame < 12; ++frame) {
      // Vertices take a tenth of the work.
      settings.work_budget = (200 + 100 * frame) / (detail == ContactDetail::vertices ? 10 : 1);
      const ReportHandle found = moving.built_afresh(settings, frame);
      SceneSettings unlimited = settings_of(0.05, 1000, detail);
      const ReportHandle truth = moving.built_afresh(unlimited, frame);
      for (const PairReport& pair : found->pairs()) {
        const PairReport* const exact = find_pair(*truth, pair.a, pair.b);
        REQUIRE(exact != nullptr);
        if (pair.complete) {
          REQUIRE(text_of(*found, pair) == text_of(*truth, *exact));
          ++done;
        } else {
          REQUIRE(pair.distance.lower <= exact->distance.lower);
          REQUIRE(pair.distance.upper >= exact->distance.upper);
          ++undone;
        }
      }
      // Nothing that is in range is missing.
      for (const PairReport& pair : truth->pairs())
        if (pair.phase == PairPhase::began || pair.distance.lower < 0.25)
          REQUIRE(find_pair(*found, pair.a, pair.b) != nullptr);
    }
    CHECK(done > 20);
    CHECK(undone > 20);
  }
}

TEST_CASE("urgent pairs come first: those in contact, then the nearest") {
  for (const ContactDetail detail :
       {ContactDetail::closest, ContactDetail::features, ContactDetail::vertices, ContactDetail::nearest}) {
    const double contact_distance = 0.125;
    const auto completed = [&](std::uint64_t budget) {
      SceneSettings settings = settings_of(contact_distance, 100, detail);
      settings.work_budget = budget;
      Stack stack(settings);
      const ReportHandle report = stack.scene.step();
      std::vector<std::pair<double, bool>> order;
      for (const PairReport& pair : report->pairs()) {
        const auto place = [&](ObjectId id) {
          return static_cast<std::size_t>(std::find(stack.ids.begin(), stack.ids.end(), id) -
                                          stack.ids.begin());
        };
        order.emplace_back(std::abs(stack.heights[place(pair.a)] - stack.heights[place(pair.b)]),
                           pair.complete);
      }
      std::sort(order.begin(), order.end());
      return order;
    };
    std::size_t partly = 0;
    for (std::uint64_t budget = 1; budget < 20000; budget += 1 + budget / 8) {
      const auto order = completed(budget);
      REQUIRE(order.size() == 6);
      const auto is_complete = [](const auto& pair) { return pair.second; };
      const auto done = std::count_if(order.begin(), order.end(), is_complete);
      REQUIRE(std::is_partitioned(order.begin(), order.end(), is_complete));
      partly += done > 0 && done < 6 ? 1U : 0U;
    }
    CHECK(partly > 3);
  }
}

namespace {

/// A ball in a slightly larger one, without contact, which takes long. Beside it two boxes that pierce each
/// other.
struct LongAndUrgent {
  explicit LongAndUrgent(const SceneSettings& settings) : scene(settings) {
    for (const auto& mesh : {box, box, ball, outer}) ids.push_back(scene.add(mesh));
  }
  ReportHandle step(std::size_t frame) {
    const double shift = 0.003 * std::sin(static_cast<double>(frame));
    scene.set_positions(ids[0], lifted(*box, 20));
    scene.set_positions(ids[1], lifted(*box, 20.99 + shift));
    scene.set_positions(ids[2], lifted(*ball, shift));
    scene.set_positions(ids[3], lifted(*outer, 0));
    return scene.step();
  }
  std::shared_ptr<const Mesh> box = mesh_of(models::box({1, 1, 1}));
  std::shared_ptr<const Mesh> ball = mesh_of(models::sphere(60, 40));
  std::shared_ptr<const Mesh> outer = mesh_of(scaled(models::sphere(58, 42), 1.25));
  Scene scene;
  std::vector<ObjectId> ids;

 private:
  static models::MeshData scaled(models::MeshData mesh, double by) {
    for (Eigen::Vector3d& position : mesh.positions) position *= by;
    return mesh;
  }
};

}  // namespace

TEST_CASE("with a time budget urgent pairs come before those that took long") {
  SceneSettings settings = settings_of(0.05, 1, ContactDetail::features);
  settings.threads = 1;
  LongAndUrgent unlimited(settings);
  double jobs_ms = 0;
  for (std::size_t frame = 0; frame < 4; ++frame) jobs_ms = unlimited.step(frame)->statistics().times.jobs_ms;
  settings.time_budget = std::chrono::microseconds(static_cast<std::int64_t>(1000 * jobs_ms / 2));
  LongAndUrgent limited(settings);
  std::size_t cut = 0;
  std::size_t urgent = 0;
  for (std::size_t frame = 0; frame < 12; ++frame) {
    const ReportHandle report = limited.step(frame);
    if (frame < 2) continue;
    const PairReport* const boxes = find_pair(*report, limited.ids[0], limited.ids[1]);
    const PairReport* const balls = find_pair(*report, limited.ids[2], limited.ids[3]);
    REQUIRE(boxes != nullptr);
    REQUIRE(balls != nullptr);
    cut += balls->complete ? 0U : 1U;
    urgent += boxes->complete ? 1U : 0U;
  }
  CHECK(cut >= 5);
  CHECK(urgent >= 8);  // the clock may stop elsewhere
}

TEST_CASE("an undone pair keeps the phase it had") {
  SceneSettings settings = settings_of(0.5, 4);
  settings.work_budget = 1;
  // One pair of single regions costs one. The second pair finds nothing left.
  Scene scene(settings);
  const ObjectId plate = scene.add(plate_mesh());
  const ObjectId needle = scene.add(needle_mesh());
  scene.set_positions(needle, lifted(*needle_mesh(), 0.25));
  REQUIRE(only_pair(*scene.step()).phase == PairPhase::began);
  REQUIRE(scene.latest_report()->complete());
  // A second contact, of an object nearer to the plate: both were not in contact with each other before.
  const ObjectId other = scene.add(plate_mesh());
  scene.set_positions(other, lifted(*plate_mesh(), 3));
  scene.set_positions(needle, lifted(*needle_mesh(), 0.375));  // what has not moved costs nothing
  const ReportHandle report = scene.step();
  REQUIRE(report->pairs().size() == 3);
  CHECK(find_pair(*report, plate, needle)->complete);
  CHECK(find_pair(*report, plate, needle)->phase == PairPhase::touching);
  CHECK(find_pair(*report, plate, needle)->distance.upper == 0.375);
  CHECK(find_pair(*report, plate, other)->phase == PairPhase::near);
  CHECK_FALSE(find_pair(*report, plate, other)->complete);
  CHECK_FALSE(find_pair(*report, needle, other)->complete);
  CHECK(find_pair(*report, needle, other)->phase == PairPhase::near);
  CHECK_FALSE(report->complete());
}

TEST_CASE("a contact whose turn does not come is still one, without contacts") {
  SceneSettings settings = settings_of(0.5, 4);
  settings.work_budget = 2;
  Scene scene(settings);
  const ObjectId low = scene.add(plate_mesh());
  const ObjectId middle = scene.add(needle_mesh());
  scene.set_positions(middle, lifted(*needle_mesh(), 0.25));
  REQUIRE(scene.step()->complete());
  std::vector<ObjectId> more;
  for (int i = 0; i < 2; ++i) {
    more.push_back(scene.add(needle_mesh()));
    scene.set_positions(more.back(), moved(needle_mesh()->rest(), {-1, -1.0 - i, 0.25 * (i + 1)}));
    scene.ignore(more.back(), middle);
    if (i == 1) scene.ignore(more[0], more[1]);
    scene.step();
  }
  // Three pairs of the low plate, two units of work.
  const ReportHandle report = scene.step();
  CHECK(inconsistency_of(*report) == "");
  std::size_t undone = 0;
  for (const PairReport& pair : report->pairs()) {
    CHECK(pair.a == low);
    undone += pair.complete ? 0U : 1U;
    CHECK(report->contacts(pair).empty() == !pair.complete);
  }
  CHECK(undone == 1);
}

}  // namespace graze::tests
