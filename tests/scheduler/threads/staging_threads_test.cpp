// Calls from several threads at once: where the outcome is defined, it is that of the same calls one after
// the other.

#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// Runs `work(0)` to `work(count - 1)` on threads of their own and `meanwhile` on this one until they are
/// done.
template <typename Work, typename Meanwhile>
void run_on_threads(std::size_t count, const Work& work, const Meanwhile& meanwhile) {
  std::atomic<std::size_t> working = count;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i)
    threads.emplace_back([&, i] {
      work(i);
      --working;
    });
  while (working > 0) meanwhile();
  for (std::thread& thread : threads) thread.join();
}

/// Positions that objects may get. This memory is never written again, so it may be bound at any time.
const std::vector<Positions>& places() {
  static const std::vector<Positions> all = [] {
    std::vector<Positions> made;
    for (int i = 0; i < 16; ++i) made.push_back(moved(needle_mesh()->rest(), {0.125 * i, 0, 0.25 * i}));
    return made;
  }();
  return all;
}

Eigen::Isometry3d pose_of(std::size_t place) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = places()[place][0] - needle_mesh()->rest()[0];
  return pose;
}

constexpr std::size_t own_objects = 4;  ///< of each writer: two deformable, two rigid

/// One thread that moves and filters objects of its own in every way, and remembers its last word on each.
class Mover {
 public:
  Mover(Scene& scene, std::uint64_t seed) : scene_(scene), random_(seed) {
    for (std::size_t i = 0; i < own_objects; ++i)
      ids_[i] = scene.add(needle_mesh(), motion_of(i < 2 ? Motion::deformable : Motion::rigid));
  }

  void run(int operations) {
    for (int i = 0; i < operations; ++i) act();
    for (std::size_t object = 0; object < own_objects; ++object) place(object);
  }
  /// Says the same to another scene in which objects `first` to `first + 3` are those of this thread.
  void say_last(Scene& scene, std::span<const ObjectId> ids) const {
    for (std::size_t i = 0; i < own_objects; ++i)
      if (i < 2)
        scene.set_positions(ids[i], places()[place_[i]]);
      else
        scene.set_pose(ids[i], pose_of(place_[i]));
    for (const auto& pair : ignored_) scene.ignore(ids[pair.first], ids[pair.second]);
  }

 private:
  std::size_t any_object() { return random_.below(own_objects); }
  void place(std::size_t object) {
    place_[object] = random_.below(static_cast<std::uint32_t>(places().size()));
    const Positions& positions = places()[place_[object]];
    if (object >= 2)
      return random_.chance(0.5) ? place_both() : scene_.set_pose(ids_[object], pose_of(place_[object]));
    if (random_.chance(0.5)) return scene_.set_positions(ids_[object], positions);
    const BindPolicy policy = random_.chance(0.5) ? BindPolicy::when_told : BindPolicy::every_step;
    scene_.bind_positions(ids_[object], positions, policy);
  }
  /// Both rigid ones by one call.
  void place_both() {
    scene_.set_poses(std::span<const ObjectId>(ids_).subspan(2),
                     std::array{pose_of(place_[2]), pose_of(place_[3])});
  }
  void act() {
    const std::uint32_t what = random_.below(10);
    const std::size_t object = any_object();
    if (what == 0) {
      const std::size_t other = (object + 1 + random_.below(own_objects - 1)) % own_objects;
      const auto pair = std::minmax(object, other);
      if (random_.chance(0.5)) {
        scene_.ignore(ids_[object], ids_[other]);
        ignored_.insert(pair);
      } else {
        scene_.watch(ids_[object], ids_[other]);
        ignored_.erase(pair);
      }
    } else if (what == 1 && object < 2) {
      scene_.positions_changed(ids_[object]);
    } else if (what == 2 && object < 2) {
      scene_.unbind_positions(ids_[object]);
      place(object);
    } else {
      place(object);
    }
  }

  Scene& scene_;
  oracle::Random random_;
  std::array<ObjectId, own_objects> ids_;
  std::array<std::size_t, own_objects> place_{};
  std::set<std::pair<std::size_t, std::size_t>> ignored_;
};

/// Objects that any thread may look at or speak to while another removes them: ids packed into a word.
class Board {
 public:
  static constexpr std::size_t size = 8;
  void put(std::size_t place, ObjectId id) { places_[place] = std::uint64_t{id.generation} << 32 | id.index; }
  [[nodiscard]] ObjectId look(std::size_t place) const {
    const std::uint64_t word = places_[place];
    return {static_cast<std::uint32_t>(word), static_cast<std::uint32_t>(word >> 32)};
  }

 private:
  std::array<std::atomic<std::uint64_t>, size> places_{};
};

/// One thread that adds objects, shows them to the others, removes them, and speaks to whatever the others
/// show.
class Churner {
 public:
  Churner(Scene& scene, Board& board, std::uint64_t seed) : scene_(scene), board_(board), random_(seed) {}

  void run(int operations) {
    for (int i = 0; i < operations; ++i) act();
  }
  [[nodiscard]] const std::vector<ObjectId>& alive() const { return alive_; }
  [[nodiscard]] const std::vector<ObjectId>& given() const { return given_; }
  [[nodiscard]] std::size_t problems() const { return problems_; }

 private:
  void act() {
    const std::uint32_t what = random_.below(8);
    if (what < 2) return add();
    if (what == 2) return remove();
    const ObjectId shown = board_.look(random_.below(Board::size));
    if (what == 3) scene_.set_positions(shown, places()[random_.below(16)]);
    if (what == 4) scene_.set_pose(shown, pose_of(random_.below(16)));
    if (what == 5 && !alive_.empty()) scene_.ignore(shown, alive_.back());
    if (what == 6) look_at(shown);
    if (what == 7 && !scene_.contains(alive_.empty() ? add_one() : alive_.back())) ++problems_;
  }
  ObjectId add_one() {
    add();
    return alive_.back();
  }
  void add() {
    if (alive_.size() >= 6) return remove();
    // Its name and number say the same, which a half-written or emptied one would not.
    ObjectSettings settings = motion_of(random_.chance(0.5) ? Motion::rigid : Motion::deformable);
    settings.user_data = random_.next();
    settings.name = "an object with a long name: " + std::to_string(settings.user_data);
    alive_.push_back(scene_.add(needle_mesh(), settings));
    given_.push_back(alive_.back());
    board_.put(random_.below(Board::size), alive_.back());
  }
  void remove() {
    if (alive_.empty()) return;
    const std::size_t place = random_.below(static_cast<std::uint32_t>(alive_.size()));
    scene_.remove(alive_[place]);
    if (scene_.contains(alive_[place]) || scene_.mesh(alive_[place]) != nullptr) ++problems_;
    alive_.erase(alive_.begin() + static_cast<std::ptrdiff_t>(place));
  }
  void look_at(ObjectId id) {
    const auto mesh = scene_.mesh(id);
    if (mesh != nullptr && mesh->vertex_count() != 3) ++problems_;
    const ObjectSettings settings = scene_.object_settings(id);
    if (!settings.name.empty() &&
        settings.name != "an object with a long name: " + std::to_string(settings.user_data))
      ++problems_;
  }

  Scene& scene_;
  Board& board_;
  oracle::Random random_;
  std::vector<ObjectId> alive_;
  std::vector<ObjectId> given_;
  std::size_t problems_ = 0;
};

}  // namespace

TEST_CASE("of each thread's calls on its own objects the last counts") {
  constexpr std::size_t thread_count = 4;
  constexpr int operations = 8000;
  SceneSettings settings = settings_of(0.25, 1, ContactDetail::closest);
  settings.threads = 2;
  Scene scene(settings);
  scene.add(plate_mesh());
  std::vector<Mover> movers;
  for (std::uint64_t seed = 0; seed < thread_count; ++seed) movers.emplace_back(scene, seed);
  std::size_t problems = 0;
  run_on_threads(
      thread_count, [&](std::size_t i) { movers[i].run(operations); },
      [&] {
        const ReportHandle report = scene.step();
        if (!report->diagnostics().empty() || !inconsistency_of(*report).empty()) ++problems;
      });
  CHECK(problems == 0);

  Scene afresh(settings);
  afresh.add(plate_mesh());
  std::vector<ObjectId> ids;
  for (std::size_t i = 0; i < thread_count * own_objects; ++i)
    ids.push_back(
        afresh.add(needle_mesh(), motion_of(i % own_objects < 2 ? Motion::deformable : Motion::rigid)));
  for (std::size_t i = 0; i < thread_count; ++i)
    movers[i].say_last(afresh, std::span<const ObjectId>(ids).subspan(i * own_objects, own_objects));
  CHECK(scene.step()->diagnostics().empty());
  const ReportHandle report = scene.step();  // what was filtered out last has ended in the one before
  CHECK(report->pairs().size() > thread_count);
  CHECK(timeless_rows_of(*report, settings.range) == timeless_rows_of(*afresh.step(), settings.range));
}

TEST_CASE("threads add, remove, look at and speak to each other's objects") {
  constexpr std::size_t thread_count = 4;
  constexpr int operations = 10000;
  SceneSettings settings = settings_of(0.25, 1, ContactDetail::none);
  settings.threads = 2;
  Scene scene(settings);
  Board board;
  std::vector<Churner> churners;
  for (std::uint64_t seed = 0; seed < thread_count; ++seed) churners.emplace_back(scene, board, seed);
  std::size_t problems = 0;
  const auto step = [&] {
    const ReportHandle report = scene.step();
    if (!inconsistency_of(*report).empty()) ++problems;
    // Others' objects may have gone or be of the other motion. An object may be shown to its own thread.
    for (const Diagnostic& diagnostic : report->diagnostics())
      if (diagnostic.kind != DiagnosticKind::stale_id && diagnostic.kind != DiagnosticKind::wrong_motion &&
          diagnostic.kind != DiagnosticKind::bad_pair)
        ++problems;
  };
  run_on_threads(
      thread_count, [&](std::size_t i) { churners[i].run(operations); }, step);
  step();
  CHECK(problems == 0);

  std::set<ObjectId> given;
  std::size_t given_count = 0;
  std::vector<ObjectId> alive;
  for (const Churner& churner : churners) {
    CHECK(churner.problems() == 0);
    given.insert(churner.given().begin(), churner.given().end());
    given_count += churner.given().size();
    alive.insert(alive.end(), churner.alive().begin(), churner.alive().end());
  }
  CHECK(given.size() == given_count);  // no id twice
  CHECK(given_count > thread_count * operations / 10);
  CHECK(scene.object_count() == alive.size());
  std::size_t wrong = 0;
  for (const ObjectId id : given)
    if (scene.contains(id) != (std::find(alive.begin(), alive.end(), id) != alive.end())) ++wrong;
  CHECK(wrong == 0);

  // Moves all objects that are left. A scene made afresh of the same objects must then report the same,
  // whatever calls came before.
  const std::size_t count = alive.size();
  Scene afresh(settings);
  for (std::size_t i = 0; i < count; ++i) {
    const ObjectSettings was = scene.object_settings(alive[i]);
    const ObjectId id = afresh.add(needle_mesh(), was);
    for (const auto& [where, object] : {std::pair(&scene, alive[i]), std::pair(&afresh, id)})
      if (was.motion == Motion::rigid)
        where->set_pose(object, pose_of(i % 16));
      else
        where->set_positions(object, places()[i % 16]);
    for (std::size_t other = 0; other < i; ++other) scene.watch(alive[i], alive[other]);
  }
  CHECK(scene.step()->statistics().objects == count);
  const auto distances = [&](const FrameReport& report) {
    std::multiset<double> all;
    for (const PairReport& pair : report.pairs())
      if (pair.phase != PairPhase::ended) all.insert(pair.distance.upper);
    return all;
  };
  CHECK(distances(*scene.step()) == distances(*afresh.step()));
}

TEST_CASE("of threads that remove the same object one does") {
  constexpr std::size_t thread_count = 4;
  constexpr std::size_t object_count = 2000;
  Scene scene(settings_of(0, 0, ContactDetail::none));
  std::vector<ObjectId> ids;
  for (std::size_t i = 0; i < object_count; ++i) {
    ids.push_back(scene.add(needle_mesh(), motion_of(Motion::rigid)));
    scene.set_pose(ids[i], lift_pose(10.0 * static_cast<double>(i)));
  }
  std::size_t stale = 0;
  const auto step = [&] {
    const ReportHandle report = scene.step();
    for (const Diagnostic& diagnostic : report->diagnostics())
      if (diagnostic.kind == DiagnosticKind::stale_id) ++stale;
  };
  run_on_threads(
      thread_count,
      [&](std::size_t) {
        for (const ObjectId id : ids) scene.remove(id);
      },
      step);
  step();
  CHECK(stale == (thread_count - 1) * object_count);
  CHECK(scene.object_count() == 0);
  CHECK(scene.step()->statistics().objects == 0);
}

TEST_CASE("memory that a thread binds no more is free, also while others unbind the same object") {
  constexpr int rounds = 500;
  NeedleOverPlate pair(settings_of(0.25, 100));
  for (int step = 0; step < 20; ++step) {
    const auto last = std::make_unique<Positions>(lifted(*needle_mesh(), 64));
    run_on_threads(
        3,
        [&](std::size_t thread) {
          auto bound = std::make_unique<Positions>();
          for (int round = 0; round < rounds; ++round) {
            if (thread == 0) {
              auto next = std::make_unique<Positions>(lifted(*needle_mesh(), round % 64));
              pair.scene.bind_positions(pair.needle, *next);
              bound = std::move(next);  // frees what was bound before
            } else {
              pair.scene.unbind_positions(pair.needle);
            }
          }
          // The last binding ends before its memory does. A copy would end it too, or other memory.
          if (thread == 0) pair.scene.bind_positions(pair.needle, *last);
        },
        [] { std::this_thread::yield(); });
    pair.scene.unbind_positions(pair.needle);
    const ReportHandle report = pair.scene.step();
    CHECK(report->diagnostics().empty());
    CHECK(only_pair(*report).distance.upper == 64);
  }
}

}  // namespace graze::tests
