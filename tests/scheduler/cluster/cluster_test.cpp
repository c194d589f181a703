// Ranks that are threads of this process say together what one scene says, bit for bit.

#include <array>
#include <cstdio>
#include <string>
#include <thread>

#include "scheduler/cluster/cluster_play.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/error_of.hpp"

namespace graze::tests {
namespace {

/// The first frame and text in which two plays differ.
std::string difference_of_plays(const std::vector<std::vector<std::string>>& one,
                                const std::vector<std::vector<std::string>>& other) {
  for (std::size_t frame = 0; frame < one.size(); ++frame) {
    for (std::size_t i = 0; i < std::max(one[frame].size(), other[frame].size()); ++i) {
      const std::string left = i < one[frame].size() ? one[frame][i] : "nothing";
      const std::string right = i < other[frame].size() ? other[frame][i] : "nothing";
      if (left != right)
        return "frame " + std::to_string(frame + 1) + ", text " + std::to_string(i) + ":\n" + left + "\n" +
               right;
    }
  }
  return {};
}

/// Whether a text of a report speaks of an object of a rank.
bool is_of(const std::string& text, int rank, int ranks) {
  unsigned a = 0;
  unsigned b = 0;
  if (std::sscanf(text.c_str(), "%u:1 %u:1", &a, &b) == 2)
    return first_rank_of(a, ranks) == rank || first_rank_of(b, ranks) == rank;
  return std::sscanf(text.c_str(), "%u: ", &a) == 1 && first_rank_of(a, ranks) == rank;
}

/// The part of a play that a rank gets whose objects stay.
std::vector<std::vector<std::string>> part_of(const std::vector<std::vector<std::string>>& all, int rank,
                                              int ranks) {
  std::vector<std::vector<std::string>> part(all.size());
  for (std::size_t frame = 0; frame < all.size(); ++frame)
    for (const std::string& text : all[frame])
      if (is_of(text, rank, ranks)) part[frame].push_back(text);
  return part;
}

/// Plays with objects that stay where they were added, and with objects that go to other ranks.
void require_same_plays(const PlaySettings& settings, int most_ranks = 4) {
  const auto frames = calls_of(settings);
  const auto one = played_by_one(settings, frames);
  std::size_t rows = 0;
  for (const auto& texts : one) rows += texts.size();
  INFO("seed " << settings.seed);
  REQUIRE(rows > settings.frames);
  for (int ranks = 1; ranks <= most_ranks; ++ranks) {
    INFO(ranks << " ranks");
    for (const std::optional<double> max_imbalance : {std::optional<double>(), std::optional<double>(1.01)}) {
      INFO((max_imbalance ? "moving" : "staying"));
      const Played played = played_by_cluster(settings, frames, ranks, {max_imbalance});
      CHECK(played.problem == "");
      CHECK(difference_of_plays(one, played.gathered) == "");
      if (ranks > 1) CHECK(played.sum.ghosts > 0);
      for (int rank = 0; rank < ranks && !max_imbalance; ++rank)
        CHECK(difference_of_plays(part_of(one, rank, ranks),
                                  played.by_rank[static_cast<std::size_t>(rank)]) == "");
      if (ranks > 1 && max_imbalance) CHECK(played.sum.arrivals > 0);
    }
  }
}

/// Lets threads work as ranks, and returns for each what Error it has thrown.
template <typename Work>
std::vector<std::string> problems_of(int ranks, const Work& work) {
  const auto transports = cluster::thread_transports(ranks);
  std::vector<std::string> problems(transports.size());
  std::vector<std::thread> threads;
  for (std::size_t rank = 0; rank < transports.size(); ++rank)
    threads.emplace_back([&, rank] { problems[rank] = error_of([&] { work(rank, transports[rank]); }); });
  for (std::thread& thread : threads) thread.join();
  return problems;
}

PlaySettings play_of(std::uint64_t seed, ContactDetail detail) {
  PlaySettings settings;
  settings.seed = seed;
  settings.scene = settings_of(0.2, 0.5, detail);
  settings.scene.threads = 1;
  return settings;
}

}  // namespace

TEST_CASE("cluster: as one scene, features") {
  for (std::uint64_t seed = 1; seed <= repeats(8); ++seed)
    require_same_plays(play_of(seed, ContactDetail::features));
}

TEST_CASE("cluster: as one scene, nearest with solids and ways out") {
  for (std::uint64_t seed = 1; seed <= repeats(8); ++seed) {
    PlaySettings settings = play_of(seed, ContactDetail::nearest);
    settings.solids = true;
    settings.scene.ways_out = true;
    settings.scene.carrying = 4;
    require_same_plays(settings);
  }
}

TEST_CASE("cluster: as one scene, swept") {
  for (std::uint64_t seed = 1; seed <= repeats(8); ++seed) {
    PlaySettings settings = play_of(seed, ContactDetail::closest);
    settings.swept = true;
    settings.scene.swept_gap = seed % 2 == 0 ? 0.1 : 0;
    require_same_plays(settings);
  }
}

TEST_CASE("cluster: as one scene, self") {
  for (std::uint64_t seed = 1; seed <= repeats(8); ++seed) {
    PlaySettings settings = play_of(seed, ContactDetail::nearest);
    settings.self = settings.solids = settings.swept = true;
    require_same_plays(settings);
  }
}

TEST_CASE("cluster: as one scene, the paper's method") {
  PlaySettings settings = play_of(1, ContactDetail::features);
  settings.scene.accuracy = Accuracy::paper({2.0, 1.0, 0.5, 0.3, 0.25, 0.2});
  settings.scene.detail = ContactDetail::vertices;
  require_same_plays(settings);
}

namespace {

ClusterCall added(std::uint32_t number, std::shared_ptr<const Mesh> mesh, Motion motion, bool swept = false) {
  ClusterCall call;
  call.kind = ClusterCall::Kind::add;
  call.number = number;
  call.mesh = std::move(mesh);
  call.settings.motion = motion;
  call.settings.swept = swept;
  return call;
}

ClusterCall posed(std::uint32_t number, double x) {
  ClusterCall call;
  call.number = number;
  call.pose = {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0};
  return call;
}

/// Plays calls that were not drawn at random.
void require_same_calls(const PlaySettings& settings, std::span<const std::vector<ClusterCall>> frames) {
  const auto one = played_by_one(settings, frames);
  REQUIRE(!one.back().empty());
  for (const std::optional<double> max_imbalance : {std::optional<double>(), std::optional<double>(1.1)}) {
    const Played played = played_by_cluster(settings, frames, 2, {max_imbalance});
    CHECK(played.problem == "");
    CHECK(difference_of_plays(one, played.gathered) == "");
    CHECK((played.sum.arrivals > 0) == max_imbalance.has_value());
  }
}

}  // namespace

TEST_CASE("cluster: an object that was only surveyed goes to another rank with the place it has now") {
  const auto ball = mesh_of(models::sphere(6, 4));
  std::vector<std::vector<ClusterCall>> frames(16);
  frames[0].push_back(added(0, ball, Motion::deformable));
  // All of them belong to rank 0 at first: a pile, and the ball that flies off alone.
  for (const std::uint32_t number : {1U, 2U, 6U, 7U, 8U, 12U}) {
    frames[0].push_back(added(number, ball, Motion::rigid));
    frames[0].push_back(posed(number, 0.3 * number));
  }
  for (std::size_t frame = 0; frame < 6; ++frame) {
    ClusterCall call;
    call.kind = ClusterCall::Kind::positions;
    call.positions = moved(ball->rest(), {30 + 2.0 * static_cast<double>(frame), 0, 0});
    frames[frame].push_back(call);
  }
  frames[15].push_back(posed(1, 41.5));
  require_same_calls(play_of(1, ContactDetail::features), frames);
}

TEST_CASE("cluster: the first swept object sweeps objects of other ranks in its first step") {
  const auto ball = mesh_of(models::sphere(6, 4));
  std::vector<std::vector<ClusterCall>> frames(12);
  frames[0] = {added(0, ball, Motion::rigid), posed(0, -6)};
  for (const std::uint32_t number : {1U, 2U, 6U, 7U}) {
    frames[0].push_back(added(number, ball, Motion::rigid));
    frames[0].push_back(posed(number, 20 + 0.3 * number));
  }
  frames[11] = {added(9, ball, Motion::rigid, true), posed(9, 0), posed(0, 6)};
  REQUIRE(first_rank_of(9, 2) != first_rank_of(0, 2));
  require_same_calls(play_of(1, ContactDetail::features), frames);
}

TEST_CASE("cluster: ranks with different settings are found out") {
  const auto problems = problems_of(2, [](std::size_t rank, std::shared_ptr<cluster::Transport> transport) {
    cluster::Scene scene({.contact_distance = rank == 0 ? 0.1 : 0.2}, transport);
    (void)scene.step();
  });
  for (const std::string& problem : problems)
    CHECK(problem.find("the ranks of a cluster have different settings") != std::string::npos);
}

TEST_CASE("cluster: a long run") {
  PlaySettings settings = play_of(5, ContactDetail::nearest);
  settings.frames = repeats(400);
  settings.is_long = true;
  settings.swept = settings.self = settings.solids = true;
  const auto frames = calls_of(settings);
  const auto one = played_by_one(settings, frames);
  const Played played = played_by_cluster(settings, frames, 4, {1.1});
  CHECK(difference_of_plays(one, played.gathered) == "");
  CHECK(played.sum.arrivals > 10);
}

TEST_CASE("cluster: many ranks, of which some have no object") {
  PlaySettings settings = play_of(3, ContactDetail::nearest);
  settings.objects = 5;
  settings.swept = true;
  const auto frames = calls_of(settings);
  const auto one = played_by_one(settings, frames);
  for (const std::optional<double> max_imbalance : {std::optional<double>(), std::optional<double>(1.2)})
    CHECK(difference_of_plays(one, played_by_cluster(settings, frames, 11, {max_imbalance}).gathered) == "");
}

TEST_CASE("cluster: threads as ranks that are slow, and messages that come late") {
  PlaySettings settings = play_of(4, ContactDetail::features);
  settings.late = true;
  const auto frames = calls_of(settings);
  const auto one = played_by_one(settings, frames);
  CHECK(difference_of_plays(one, played_by_cluster(settings, frames, 3, {1.05}).gathered) == "");
}

TEST_CASE("cluster: what it does not offer is refused") {
  const auto refusal = [](SceneSettings settings, const cluster::ClusterSettings& cluster = {}) {
    return error_of([&] { cluster::Scene(settings, cluster::thread_transports(1).front(), cluster); });
  };
  CHECK(refusal({}) == "");
  CHECK(refusal({.time_budget = std::chrono::microseconds(1)}) == "a cluster does not offer time budgets");
  CHECK(refusal({.work_budget = 1}) == "a cluster does not offer work budgets");
  CHECK(refusal({.max_contacts = 1}) == "a cluster does not offer a limit of all contacts");
  CHECK(refusal({.region_distances = 1}) == "a cluster does not offer distances of regions");
  CHECK(refusal({.contact_distance = -1}) != "");
  CHECK(refusal({}, {.max_imbalance = 1.0}) != "");
  CHECK(error_of([] { cluster::Scene({}, nullptr); }) == "a cluster's scene needs a transport");
  CHECK(error_of([] { (void)cluster::thread_transports(0); }) != "");
  cluster::Scene scene({}, cluster::thread_transports(1).front());
  CHECK(error_of([&] { scene.add(0, plate_mesh(), {.queries = true}); }) != "");
  CHECK(error_of([&] { scene.add(0, plate_mesh(), {.patch_radius = 1}); }) != "");
  CHECK(error_of([&] { scene.add(0, nullptr); }) != "");
  CHECK(scene.owned().empty());
  CHECK(scene.add(7, plate_mesh()) == cluster::Scene::id_of(7));
  CHECK(error_of([&] { scene.add(7, plate_mesh()); }) != "");
  CHECK(scene.owns(cluster::Scene::id_of(7)));
  CHECK(scene.mesh(cluster::Scene::id_of(7)) != nullptr);
  CHECK(scene.mesh(cluster::Scene::id_of(8)) == nullptr);
  scene.remove(cluster::Scene::id_of(7));
  CHECK(!scene.owns(cluster::Scene::id_of(7)));
}

TEST_CASE("cluster: a rank that fails ends the steps of all") {
  const auto problems = problems_of(3, [](std::size_t rank, std::shared_ptr<cluster::Transport> transport) {
    cluster::Scene scene({}, transport);
    for (int frame = 0; frame < 5; ++frame) {
      if (frame == 3 && rank == 1) return transport->fail("has no more to say");
      (void)scene.step();
    }
  });
  CHECK(problems[0] == "rank 1 has no more to say");
  CHECK(problems[1] == "");
  CHECK(problems[2] == "rank 1 has no more to say");
}

TEST_CASE("cluster: a rank that cannot gather tells the others") {
  /// Has no room for what others send.
  class Narrow final : public ForwardingTransport {
   public:
    using ForwardingTransport::ForwardingTransport;
    [[nodiscard]] std::vector<Bytes> gather(std::span<const std::byte>) override {
      throw Error("there is no room for the rows of all");
    }
  };
  const auto problems = problems_of(2, [](std::size_t rank, std::shared_ptr<cluster::Transport> transport) {
    if (rank == 0) transport = std::make_shared<Narrow>(transport);
    cluster::Scene scene({}, transport);
    (void)scene.step();
    (void)scene.gather();
    (void)scene.step();
  });
  CHECK(problems[0] == "there is no room for the rows of all");
  CHECK(problems[1] == "rank 0 failed: there is no room for the rows of all");
}

TEST_CASE("cluster: two objects of one number near each other are found out") {
  const auto problems = problems_of(2, [](std::size_t rank, std::shared_ptr<cluster::Transport> transport) {
    cluster::Scene scene({}, transport);
    for (std::uint32_t number = 0; number < 4; ++number)
      if (number != 1 || rank == 0) scene.add(number, plate_mesh());
    (void)scene.step();
  });
  CHECK((problems[0] + problems[1]).find("two ranks own an object of number") != std::string::npos);
}

}  // namespace graze::tests
