// Objects in bound memory in detail `vertices`, where a step may look at memory where it lies in place of
// reading it: beside the same objects in memory that has gaps, which is always read.

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <vector>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

constexpr double bad = std::numeric_limits<double>::quiet_NaN();

/// Positions of an object in memory of its own, with or without gaps. Between steps it holds nothing of use.
template <typename Number>
class Memory {
 public:
  Memory(std::size_t count, bool has_gaps) : each_(has_gaps ? 5 : 3), numbers_(count * each_) {}

  [[nodiscard]] PositionView view() const {
    return {numbers_.data(), numbers_.size() / each_, each_ * sizeof(Number)};
  }
  void put(const Positions& positions) {
    for (std::size_t i = 0; i < positions.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        numbers_[i * each_ + static_cast<std::size_t>(axis)] = static_cast<Number>(positions[i][axis]);
  }
  void spoil() { std::fill(numbers_.begin(), numbers_.end(), static_cast<Number>(bad)); }

 private:
  std::size_t each_;
  std::vector<Number> numbers_;
};

/// A threshold that some vertices of neighbours are nearer than.
SceneSettings vertices_on(unsigned threads, const Mesh& mesh) {
  const double threshold =
      (mesh.vertex_count() < 1000 ? 1.5 : 0.7) / std::sqrt(static_cast<double>(mesh.vertex_count()));
  SceneSettings settings = settings_of(threshold, 3 * threshold, ContactDetail::vertices);
  settings.threads = threads;
  return settings;
}

/// Objects that play the same in several scenes.
template <typename Number>
class Player {
 public:
  Player(std::shared_ptr<const Mesh> mesh, std::size_t count, unsigned threads, bool has_gaps)
      : scene_(vertices_on(threads, *mesh)), mesh_(std::move(mesh)), has_gaps_(has_gaps), ids_(count) {
    for (std::size_t i = 0; i < count; ++i) {
      memory_.push_back(fresh());
      now_.emplace_back(mesh_->rest().begin(), mesh_->rest().end());
      ids_[i] = scene_.add(mesh_);
      bind(i);
    }
  }

  void put(std::size_t object, const Positions& positions) { now_[object] = positions; }
  /// In other memory. That of before is gone as soon as the call returns.
  void bind(std::size_t object, BindPolicy policy = BindPolicy::every_step) {
    auto other = fresh();
    other->put(now_[object]);
    scene_.bind_positions(ids_[object], other->view(), policy);
    memory_[object] = std::move(other);
  }
  void unbind(std::size_t object) {
    memory_[object]->put(now_[object]);
    scene_.unbind_positions(ids_[object]);
    memory_[object] = fresh();
  }
  void copy(std::size_t object) {
    memory_[object]->put(now_[object]);
    scene_.set_positions(ids_[object], memory_[object]->view());
  }
  void promise(std::size_t object, double displacement) {
    scene_.positions_changed(ids_[object], displacement);
  }
  void replace(std::size_t object) {
    scene_.remove(ids_[object]);
    ids_[object] = scene_.add(mesh_);
    bind(object);
  }
  void reserve() {
    SceneCapacity capacity;
    capacity.objects = 2 * ids_.size();
    capacity.near_pairs = ids_.size();
    scene_.reserve(capacity);
  }

  ReportHandle step() {
    for (std::size_t i = 0; i < ids_.size(); ++i) memory_[i]->put(now_[i]);
    ReportHandle report = scene_.step();
    for (auto& memory : memory_) memory->spoil();
    return report;
  }

 private:
  [[nodiscard]] std::unique_ptr<Memory<Number>> fresh() const {
    return std::make_unique<Memory<Number>>(mesh_->vertex_count(), has_gaps_);
  }

  Scene scene_;
  std::shared_ptr<const Mesh> mesh_;
  bool has_gaps_;
  std::vector<ObjectId> ids_;
  std::vector<std::unique_ptr<Memory<Number>>> memory_;
  std::vector<Positions> now_;
};

/// A change to one object in a frame.
struct Event {
  std::size_t object = 0;
  Positions positions;
  enum class Told {
    nothing,
    bound,
    told,
    unbound,
    copied,
    promised,
    replaced,
    reserved
  } told = Told::nothing;
};

/// Mostly they go on, or rest. Some jump, and some memory is bad for a while.
class Story {
 public:
  Story(std::uint64_t seed, std::span<const Eigen::Vector3d> rest, std::size_t count)
      : random_(seed), rest_(rest.begin(), rest.end()), by_(count, Eigen::Vector3d::Zero()), turns_(count) {}

  std::vector<Event> next() {
    std::vector<Event> events;
    for (std::size_t i = 0; i < by_.size(); ++i) events.push_back(next_of(i));
    return events;
  }

 private:
  Event next_of(std::size_t object) {
    Eigen::Vector3d& by = by_[object];
    if (random_.chance(0.5)) by += 0.02 * random_point();
    if (random_.chance(0.05)) by = 2 * random_point();
    if (random_.chance(0.5)) turns_[object] += 0.05;
    const double cosine = std::cos(turns_[object]);
    const double sine = std::sin(turns_[object]);
    Event event{object, rest_, Event::Told::nothing};
    for (Eigen::Vector3d& p : event.positions)
      p = Eigen::Vector3d(cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y(), p.z()) + by;
    if (random_.chance(0.02)) event.positions[random_.below(3)].y() = bad;
    if (random_.chance(0.15)) event.told = static_cast<Event::Told>(random_.below(8));
    return event;
  }
  Eigen::Vector3d random_point() {
    const double x = random_.between(-0.5, 0.5);
    const double y = random_.between(-0.5, 0.5);
    return {x, y, random_.between(-0.5, 0.5)};
  }

  oracle::Random random_;
  Positions rest_;
  std::vector<Eigen::Vector3d> by_;
  std::vector<double> turns_;
};

template <typename Number>
void tell(Player<Number>& player, const Event& event) {
  player.put(event.object, event.positions);
  switch (event.told) {
    case Event::Told::nothing:
      return;
    case Event::Told::bound:
      return player.bind(event.object);
    case Event::Told::told:
      return player.bind(event.object, BindPolicy::when_told);
    case Event::Told::unbound:
      return player.unbind(event.object);
    case Event::Told::copied:
      return player.copy(event.object);
    case Event::Told::promised:
      return player.promise(event.object, 100);
    case Event::Told::replaced:
      return player.replace(event.object);
    case Event::Told::reserved:
      return player.reserve();
  }
}

struct Played {
  std::size_t contacts = 0;
  std::size_t phases[4] = {};
  std::size_t stale = 0;
  std::uint64_t surveyed = 0;
};

/// Plays one story with and without gaps, on one thread and on three, and compares the reports.
template <typename Number>
Played play(std::uint64_t seed, const std::shared_ptr<const Mesh>& mesh, std::size_t count,
            std::size_t steps) {
  Story story(seed, mesh->rest(), count);
  Player<Number> expected(mesh, count, 1, true);
  Player<Number> one(mesh, count, 1, false);
  Player<Number> three(mesh, count, 3, false);
  Played played;
  for (std::size_t step = 0; step < steps; ++step) {
    INFO("seed " << seed << ", step " << step);
    for (const Event& event : story.next())
      for (Player<Number>* const player : {&expected, &one, &three}) tell(*player, event);
    const ReportHandle truth = expected.step();
    const ReportHandle report = one.step();
    REQUIRE(difference_of(*report, *truth) == "");
    REQUIRE(difference_of(*three.step(), *truth) == "");
    REQUIRE(inconsistency_of(*report) == "");
    played.contacts += report->contacts().size();
    played.surveyed += report->statistics().objects_surveyed;
    for (const PairReport& pair : report->pairs()) {
      ++played.phases[static_cast<std::size_t>(pair.phase)];
      played.stale += pair.stale ? 1U : 0U;
    }
  }
  return played;
}

template <typename Number>
Played play_all(std::uint64_t seeds, const std::shared_ptr<const Mesh>& mesh, std::size_t count,
                std::size_t steps) {
  Played all;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const Played played = play<Number>(seed, mesh, count, steps);
    all.contacts += played.contacts;
    all.stale += played.stale;
    all.surveyed += played.surveyed;
    for (std::size_t i = 0; i < 4; ++i) all.phases[i] += played.phases[i];
  }
  return all;
}

}  // namespace

TEST_CASE("view: whatever happens to viewed memory, the reports are those of memory that is read") {
  const auto mesh = mesh_of(models::sphere(10, 7));
  for (const Played& played : {play_all<float>(10, mesh, 4, 60), play_all<double>(10, mesh, 4, 60)}) {
    CHECK(played.contacts > 5000);
    CHECK(played.stale > 20);
    CHECK(played.surveyed > 500);
    for (const std::size_t phase : played.phases) CHECK(phase > 20);
    std::cout << "compared " << played.contacts << " contacts of viewed memory\n";
  }
}

TEST_CASE("view: large surfaces too, which are surveyed in parts") {
  const auto mesh = mesh_of(models::sheet(95, 95, 1, 1));
  CHECK(mesh->vertex_count() > 8192);
  for (const Played& played : {play_all<float>(1, mesh, 3, 12), play_all<double>(1, mesh, 3, 12)}) {
    CHECK(played.contacts > 5000);
    CHECK(played.surveyed > 10);
  }
}

TEST_CASE("view: of large surfaces that meet in a corner blocks are made of that alone, while they move") {
  const auto mesh = mesh_of(models::sheet(95, 95, 1, 1));
  const double threshold = 0.02;
  Scene scene(settings_of(threshold, threshold, ContactDetail::vertices));
  std::array<Positions, 2> memory;
  for (Positions& positions : memory) {
    positions.assign(mesh->rest().begin(), mesh->rest().end());
    scene.bind_positions(scene.add(mesh), positions);
  }
  std::vector<double> bytes_each;
  for (int step = 0; step < 8; ++step) {
    const double by = 0.92 - 0.011 * std::min(step, 4);
    for (std::uint32_t vertex = 0; vertex < mesh->vertex_count(); ++vertex) {
      memory[0][vertex] = mesh->rest()[vertex] + Eigen::Vector3d(0.012 * std::min(step + 1, 5), 0, 0);
      memory[1][vertex] = mesh->rest()[vertex] + Eigen::Vector3d(by, by, 0.013);
    }
    const ReportHandle report = scene.step();
    std::size_t expected = 0;
    const double least = by + mesh->rest()[0].x() - threshold;
    for (const Eigen::Vector3d& a : memory[0])
      for (std::size_t i = 0; i < memory[1].size() && a.x() > least; ++i)
        expected += (a - memory[1][i]).norm() < threshold ? 1U : 0U;
    CHECK(expected > 100);
    CHECK(report->contacts().size() == expected);
    bytes_each.push_back(static_cast<double>(report->statistics().bytes.objects) /
                         (2 * static_cast<double>(mesh->vertex_count())));
  }
  // A box of 64 vertices takes 24 bytes, and one of eight as much. At rest all blocks are kept, and
  // positions.
  CHECK(*std::max_element(bytes_each.begin(), bytes_each.begin() + 5) < 2.8);
  CHECK(bytes_each.back() > 24);
}

TEST_CASE("view: of an object in a pair as of one that is far, while it moves") {
  const auto mesh = mesh_of(models::sphere(10, 7));
  const auto surveyed = [&](ContactDetail detail) {
    Scene scene(settings_of(0.1, 0.2, detail));
    std::array<Positions, 2> memory;
    for (Positions& positions : memory) {
      positions.assign(mesh->rest().begin(), mesh->rest().end());
      scene.bind_positions(scene.add(mesh), positions);
    }
    std::vector<std::size_t> counts;
    for (int step = 0; step < 8; ++step) {
      for (Eigen::Vector3d& position : memory[1]) position.x() += step < 4 ? 0.125 : 0;
      counts.push_back(scene.step()->statistics().objects_surveyed);
    }
    return counts;
  };
  // In the first step both objects are surveyed, because bound memory may hold any positions. The first
  // object rests from then on. The second moves in four steps and is read once more when it seems to rest.
  CHECK(surveyed(ContactDetail::vertices) == std::vector<std::size_t>{2, 1, 1, 1, 1, 0, 0, 0});
  CHECK(surveyed(ContactDetail::features) == std::vector<std::size_t>{2, 0, 0, 0, 0, 0, 0, 0});
}

}  // namespace graze::tests
