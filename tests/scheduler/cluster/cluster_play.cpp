#include "scheduler/cluster/cluster_play.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <thread>

#include "scheduler/report_text.hpp"

namespace graze::tests {
namespace {

using Kind = ClusterCall::Kind;

/// One object of a play, as the calls so far have left it.
struct Player {
  ObjectSettings settings;
  std::shared_ptr<const Mesh> mesh;
  Eigen::Vector3d at;
  Eigen::Vector3d speed;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  bool is_bound = false;
};

/// Draws the calls of a play.
class Director {
 public:
  explicit Director(const PlaySettings& settings) : settings_(settings), random_(settings.seed) {
    meshes_ = {mesh_of(models::sphere(6, 4)), mesh_of(models::box({1.5, 1, 2})),
               mesh_of(models::torus(7, 5, 0.9, 0.35)), mesh_of(models::sphere(5, 3, models::Faces::quads))};
    sheets_ = {mesh_of(models::sheet(4, 3, 3, 2)), mesh_of(models::sheet(3, 5, 2, 3))};
  }

  std::vector<ClusterCall> frame() {
    calls_.clear();
    if (next_ == 0) {
      for (std::size_t i = 0; i < settings_.objects; ++i) add();
      set_rule();
    } else {
      if (random_.chance(0.3) && players_.size() < 2 * settings_.objects) add();
      if (random_.chance(0.2) && players_.size() > 4) remove();
      if (random_.chance(0.2)) replace();
      if (random_.chance(0.4)) take_out();
      if (random_.chance(0.1)) set_rule();
    }
    for (auto& [number, player] : players_)
      if (random_.chance(0.8)) move(number, player);
    return calls_;
  }

 private:
  ClusterCall& call(Kind kind, std::uint32_t number) {
    ClusterCall& made = calls_.emplace_back();
    made.kind = kind;
    made.number = number;
    return made;
  }
  std::uint32_t any() {
    auto found = players_.begin();
    std::advance(found, static_cast<std::ptrdiff_t>(random_.below(players_.size())));
    return found->first;
  }
  std::vector<std::uint8_t> groups_for(const Mesh& mesh) {
    std::vector<std::uint8_t> groups(mesh.face_count());
    for (std::uint8_t& group : groups) group = static_cast<std::uint8_t>(random_.below(3));
    return groups;
  }

  void add() {
    const std::uint32_t number = next_;
    next_ += static_cast<std::uint32_t>(1 + random_.below(2));
    Player player;
    const std::size_t sort = random_.below(4);
    player.settings.motion = sort < 2 ? Motion::deformable : sort == 2 ? Motion::rigid : Motion::fixed;
    const bool is_sheet = random_.chance(0.3);
    player.mesh = is_sheet ? sheets_[random_.below(2)] : meshes_[random_.below(4)];
    player.settings.solid = settings_.solids && !is_sheet && random_.chance(0.5);
    player.settings.swept = settings_.swept && random_.chance(0.4);
    player.settings.self = settings_.self && random_.chance(0.5);
    player.settings.name = "object " + std::to_string(number);
    player.settings.user_data = 1000 + number;
    player.settings.layer = random_.chance(0.8) ? 1 : 2;
    player.settings.collides_with = random_.chance(0.9) ? ~0U : 1U;
    player.settings.group = random_.chance(0.8) ? 0 : 1 + random_.below(3);
    player.settings.margin = random_.chance(0.3) ? 0.125 : 0;
    player.settings.kind = static_cast<std::uint32_t>(random_.below(3));
    if (random_.chance(0.4)) player.settings.face_groups = groups_for(*player.mesh);
    player.at = random_.vector(0, settings_.size);
    player.speed = random_.vector(-0.4, 0.4);
    ClusterCall& made = call(Kind::add, number);
    made.mesh = player.mesh;
    made.settings = player.settings;
    if (player.settings.motion == Motion::fixed || random_.chance(0.9)) place(number, player, false);
    players_.emplace(number, std::move(player));
  }

  void remove() {
    const std::uint32_t number = any();
    call(Kind::remove, number);
    players_.erase(number);
  }

  void replace() {
    const std::uint32_t number = any();
    Player& player = players_.at(number);
    const bool is_sheet = std::find(sheets_.begin(), sheets_.end(), player.mesh) != sheets_.end();
    std::shared_ptr<const Mesh> mesh = is_sheet ? sheets_[random_.below(2)] : meshes_[random_.below(4)];
    ClusterCall& made = call(Kind::replace, number);
    for (std::uint32_t vertex = 0; vertex < player.mesh->vertex_count(); ++vertex)
      made.new_of_old.push_back(random_.chance(0.2) ? Mesh::no_vertex : vertex % mesh->vertex_count());
    if (random_.chance(0.5)) made.face_groups = groups_for(*mesh);
    made.mesh = player.mesh = std::move(mesh);
    player.is_bound = false;
  }

  void take_out() {
    const std::uint32_t number = any();
    const std::uint32_t other = any();
    if (number == other && !settings_.self) return;
    const bool is_of_groups = number == other || random_.chance(0.5);
    const bool is_ignored = random_.chance(0.6);
    ClusterCall& made = call(is_of_groups ? (is_ignored ? Kind::ignore_groups : Kind::watch_groups)
                                          : (is_ignored ? Kind::ignore : Kind::watch),
                             number);
    made.other = other;
    made.group = static_cast<std::uint8_t>(random_.below(3));
    made.other_group = static_cast<std::uint8_t>(random_.below(3));
  }

  void set_rule() {
    ClusterCall& made = call(Kind::rule, 0);
    made.number = static_cast<std::uint32_t>(random_.below(3));
    made.other = static_cast<std::uint32_t>(random_.below(3));
    made.rule.contact_distance = random_.between(0, 0.3);
    if (random_.chance(0.5)) made.rule.range = random_.between(0, 0.6);
  }

  void move(std::uint32_t number, Player& player) {
    if (player.settings.motion == Motion::fixed) return;
    const bool leaps = random_.chance(0.05);
    if (leaps) player.at = random_.vector(0, settings_.size);
    player.at += player.speed;
    for (int axis = 0; axis < 3; ++axis)
      if (player.at[axis] < 0 || player.at[axis] > settings_.size) player.speed[axis] *= -1;
    if (random_.chance(0.5)) player.turn = random_.turn();
    place(number, player, leaps && random_.chance(0.5));
  }

  void place(std::uint32_t number, Player& player, bool jumps) {
    const bool is_bad = random_.chance(0.04);
    if (player.settings.motion != Motion::deformable) {
      ClusterCall& made = call(Kind::pose, number);
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
          made.pose[static_cast<std::size_t>(4 * row + column)] = player.turn(row, column);
        made.pose[static_cast<std::size_t>(4 * row + 3)] = player.at[row];
      }
      if (is_bad) made.pose[0] += 1;
      made.jumps = jumps;
      return;
    }
    Positions positions;
    for (const Eigen::Vector3d& rest : player.mesh->rest())
      positions.push_back(player.turn * rest + player.at + random_.vector(-0.05, 0.05));
    if (is_bad) positions[random_.below(positions.size())].x() = std::numeric_limits<double>::quiet_NaN();
    if (player.is_bound && random_.chance(0.2)) {
      call(Kind::unbind, number);
      player.is_bound = false;
    }
    const bool binds = !player.is_bound && random_.chance(0.2);
    ClusterCall& made = call(player.is_bound ? Kind::write : binds ? Kind::bind : Kind::positions, number);
    player.is_bound = player.is_bound || binds;
    made.positions = std::move(positions);
    made.jumps = jumps;
  }

  const PlaySettings& settings_;
  scenes::Random random_;
  std::vector<std::shared_ptr<const Mesh>> meshes_;
  std::vector<std::shared_ptr<const Mesh>> sheets_;
  std::map<std::uint32_t, Player> players_;
  std::uint32_t next_ = 0;
  std::vector<ClusterCall> calls_;
};

/// Makes a call that a scene and a cluster's scene take alike. `id_of` gives the id of a number.
template <typename AnyScene, typename IdOf>
void make(const ClusterCall& call, AnyScene& scene, std::map<std::uint32_t, Positions>& memory,
          const IdOf& id_of) {
  const ObjectId id = id_of(call.number);
  switch (call.kind) {
    case Kind::add:
      return;
    case Kind::replace:
      scene.replace_mesh(id, call.mesh, call.new_of_old, call.face_groups);
      memory.erase(call.number);
      return;
    case Kind::remove:
      scene.remove(id);
      memory.erase(call.number);
      return;
    case Kind::pose:
      return call.jumps ? scene.set_pose_rows(id, call.pose, teleport) : scene.set_pose_rows(id, call.pose);
    case Kind::positions:
      call.jumps ? scene.set_positions(id, call.positions, teleport)
                 : scene.set_positions(id, call.positions);
      memory.erase(call.number);
      return;
    case Kind::bind:
      scene.unbind_positions(id);  // memory that it was bound to before goes now
      memory[call.number] = call.positions;
      return scene.bind_positions(id, PositionView(memory[call.number]));
    case Kind::write: {
      std::copy(call.positions.begin(), call.positions.end(), memory.at(call.number).begin());
      if (call.jumps) scene.positions_changed(id, teleport);
      return;
    }
    case Kind::unbind:
      scene.unbind_positions(id);
      memory.erase(call.number);
      return;
    case Kind::ignore:
      return scene.ignore(id, id_of(call.other));
    case Kind::watch:
      return scene.watch(id, id_of(call.other));
    case Kind::ignore_groups:
      return scene.ignore(id, call.group, id_of(call.other), call.other_group);
    case Kind::watch_groups:
      return scene.watch(id, call.group, id_of(call.other), call.other_group);
    case Kind::rule:
      return scene.set_rule(call.number, call.other, call.rule);
  }
}

}  // namespace

std::vector<std::vector<ClusterCall>> calls_of(const PlaySettings& settings) {
  Director director(settings);
  std::vector<std::vector<ClusterCall>> frames;
  for (std::size_t frame = 0; frame < settings.frames; ++frame) frames.push_back(director.frame());
  return frames;
}

namespace {

/// A hash (FNV-1a) in the place of texts, where a play is so long that these would fill the memory.
std::vector<std::string> kept(std::vector<std::string> texts, const PlaySettings& settings) {
  if (!settings.is_long) return texts;
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::string& text : texts)
    for (const char letter : text + "\n") hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  return {std::to_string(texts.size()) + " texts of hash " + std::to_string(hash)};
}

/// Appends messages in the order of their objects.
void append(const std::map<std::uint32_t, std::vector<std::string>>& diagnostics,
            std::vector<std::string>& texts) {
  for (const auto& [number, messages] : diagnostics)
    for (const std::string& message : messages) texts.push_back(std::to_string(number) + ": " + message);
}

/// A message that names an object by its number, in place of the index of its id.
std::string by_number(std::string message, std::uint32_t index, std::uint32_t number) {
  const std::string name = "object " + std::to_string(index) + " ";
  if (const std::size_t at = message.find(name); at != std::string::npos)
    message.replace(at, name.size(), "object " + std::to_string(number) + " ");
  return message;
}

}  // namespace

std::vector<std::vector<std::string>> played_by_one(const PlaySettings& settings,
                                                    std::span<const std::vector<ClusterCall>> frames) {
  Scene scene(settings.scene);
  std::map<std::uint32_t, ObjectId> ids;
  std::map<ObjectId, std::uint32_t> numbers;
  std::map<std::uint32_t, Positions> memory;
  std::vector<std::vector<std::string>> all;
  for (const std::vector<ClusterCall>& calls : frames) {
    for (const ClusterCall& call : calls) {
      if (call.kind == Kind::add) {
        const ObjectId id = ids[call.number] = scene.add(call.mesh, call.settings);
        numbers[id] = call.number;
      }
      make(call, scene, memory, [&](std::uint32_t number) {
        const auto found = ids.find(number);
        return found == ids.end() ? ObjectId() : found->second;
      });
    }
    const ReportHandle report = scene.step();
    std::vector<std::string>& texts = all.emplace_back();
    for (PairReport pair : report->pairs()) {
      pair.a = cluster::Scene::id_of(numbers.at(pair.a));
      pair.b = cluster::Scene::id_of(numbers.at(pair.b));
      texts.push_back(text_of(*report, pair));
    }
    std::map<std::uint32_t, std::vector<std::string>> diagnostics;
    for (const Diagnostic& diagnostic : report->diagnostics())
      diagnostics[numbers.at(diagnostic.object)].push_back(
          by_number(diagnostic.message, diagnostic.object.index, numbers.at(diagnostic.object)));
    append(diagnostics, texts);
    texts = kept(std::move(texts), settings);
  }
  return all;
}

int first_rank_of(std::uint32_t number, int ranks) {
  return static_cast<int>(number * 7 / 3 % static_cast<std::uint32_t>(ranks));
}

/// Binds what has come from other ranks and was bound there. Every rank has the content of all bound memory.
void PlayingRank::take(const std::vector<ClusterCall>& calls) {
  for (const ObjectId id : scene.arrived())
    if (const auto bound = memory_.find(id.index); bound != memory_.end())
      scene.bind_positions(id, PositionView(bound->second));
  for (const ClusterCall& call : calls) {
    if (call.kind == Kind::add && first_rank_of(call.number, scene.size()) == scene.rank())
      (void)scene.add(call.number, call.mesh, call.settings);
    make(call, scene, memory_, [](std::uint32_t number) { return cluster::Scene::id_of(number); });
  }
}

std::vector<std::string> texts_of(const FrameReport& report) {
  std::vector<std::string> texts;
  for (const PairReport& pair : report.pairs()) texts.push_back(text_of(report, pair));
  std::map<std::uint32_t, std::vector<std::string>> diagnostics;
  for (const Diagnostic& diagnostic : report.diagnostics())
    diagnostics[diagnostic.object.index].push_back(diagnostic.message);
  append(diagnostics, texts);
  return texts;
}

namespace {

/// A transport that takes its time, another one for each message.
class LateTransport final : public ForwardingTransport {
 public:
  explicit LateTransport(std::shared_ptr<Transport> transport)
      : ForwardingTransport(std::move(transport)), random_(static_cast<std::uint64_t>(rank())) {}

  [[nodiscard]] std::vector<Bytes> all_gather(std::span<const std::byte> given) override {
    pause();
    return ForwardingTransport::all_gather(given);
  }
  [[nodiscard]] std::vector<Bytes> gather(std::span<const std::byte> given) override {
    pause();
    return ForwardingTransport::gather(given);
  }
  void sum(std::span<std::uint64_t> numbers) override {
    pause();
    ForwardingTransport::sum(numbers);
  }
  [[nodiscard]] std::vector<Bytes> exchange(std::span<const int> ranks,
                                            std::span<const Bytes> messages) override {
    pause();
    return ForwardingTransport::exchange(ranks, messages);
  }

 private:
  void pause() { std::this_thread::sleep_for(std::chrono::microseconds(random_.below(2000))); }

  scenes::Random random_;
};

}  // namespace

Played played_by_cluster(const PlaySettings& settings, std::span<const std::vector<ClusterCall>> frames,
                         int ranks, const cluster::ClusterSettings& cluster) {
  Played played;
  played.gathered.resize(frames.size());
  played.by_rank.resize(static_cast<std::size_t>(ranks));
  std::mutex mutex;
  const auto transports = cluster::thread_transports(ranks);
  const auto run = [&](std::shared_ptr<cluster::Transport> transport) {
    try {
      if (settings.late) transport = std::make_shared<LateTransport>(std::move(transport));
      PlayingRank rank(settings, std::move(transport), cluster);
      for (std::size_t frame = 0; frame < frames.size(); ++frame) {
        rank.take(frames[frame]);
        const cluster::Report own = rank.scene.step();
        const cluster::Report all = rank.scene.gather();
        const std::lock_guard lock(mutex);
        played.by_rank[static_cast<std::size_t>(rank.scene.rank())].push_back(kept(texts_of(*own), settings));
        if (all != nullptr) played.gathered[frame] = kept(texts_of(*all), settings);
        const cluster::ClusterStatistics& of_step = rank.scene.statistics();
        played.sum.ghosts += of_step.ghosts;
        played.sum.arrivals += of_step.arrivals;
      }
    } catch (const std::exception& problem) {
      const std::lock_guard lock(mutex);
      played.problem = problem.what();
    }
  };
  std::vector<std::thread> threads;
  for (const auto& transport : transports) threads.emplace_back(run, transport);
  for (std::thread& thread : threads) thread.join();
  return played;
}

}  // namespace graze::tests
