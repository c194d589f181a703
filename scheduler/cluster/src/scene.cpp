#include <algorithm>
#include <cctype>
#include <graze/cluster/scene.hpp>
#include <graze/error.hpp>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "base/object_name.hpp"
#include "base/settings_check.hpp"
#include "calls/staging.hpp"
#include "core/base/floating_point_scope.hpp"
#include "post.hpp"
#include "rank.hpp"
#include "report/report_builder.hpp"
#include "report/report_pool.hpp"
#include "step/stepper.hpp"

namespace graze::cluster {
namespace {

std::shared_ptr<Transport> checked(std::shared_ptr<Transport> transport) {
  if (transport == nullptr) throw Error("a cluster's scene needs a transport");
  return transport;
}

const SceneSettings& checked(const SceneSettings& settings) {
  if (const auto problem = problem_of(settings)) throw Error(*problem);
  const auto refuse = [](bool is_asked, const char* what) {
    if (is_asked) throw Error(std::string("a cluster does not offer ") + what);
  };
  refuse(settings.time_budget.has_value(), "time budgets");
  refuse(settings.work_budget.has_value(), "work budgets");
  refuse(settings.max_contacts.has_value(), "a limit of all contacts");
  refuse(settings.region_distances > 0, "distances of regions");
  return settings;
}

const ClusterSettings& checked(const ClusterSettings& settings) {
  if (settings.max_imbalance && !(*settings.max_imbalance > 1))
    throw Error("a cluster is balanced from an imbalance above 1 on, not from " +
                std::to_string(*settings.max_imbalance));
  return settings;
}

/// A hash (FNV-1a) of what all ranks have alike.
std::uint64_t hash_of(SceneSettings settings, const ClusterSettings& cluster) {
  settings.threads = 0;
  settings.arena = ArenaPolicy::own;
  ByteBuffer bytes;
  write_fields(bytes, settings, cluster.max_imbalance);
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::byte byte : bytes.bytes())
    hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3U;
  return hash;
}

/// The message of a diagnostic, which names the object as callers know it.
std::string renamed(std::string message, ObjectId from, ObjectId to) {
  const std::string name = number_of(from);
  const std::size_t at = message.find(name);
  if (at == std::string::npos) return message;
  const std::size_t end = at + name.size();
  if (end < message.size() && std::isdigit(static_cast<unsigned char>(message[end])) != 0) return message;
  return message.replace(at, name.size(), number_of(to));
}

/// Diagnostics by the ids of callers, without those about ghosts.
void translate(const FrameReport& report, const Rank& rank, std::vector<Diagnostic>& diagnostics) {
  for (Diagnostic diagnostic : report.diagnostics()) {
    if (diagnostic.object != ObjectId()) {
      const auto number = rank.number_of(diagnostic.object);
      if (number && rank.ghosts().has(*number)) continue;
      const ObjectId id = number ? id_of(*number) : ObjectId();
      diagnostic.message = renamed(std::move(diagnostic.message), diagnostic.object, id);
      diagnostic.object = id;
    }
    diagnostics.push_back(std::move(diagnostic));
  }
}

}  // namespace

class Scene::State {
 public:
  State(const SceneSettings& given, std::shared_ptr<Transport> transport, const ClusterSettings& for_cluster,
        std::shared_ptr<TaskScheduler> scheduler)
      : settings(checked(given)),
        cluster(checked(for_cluster)),
        settings_hash(hash_of(settings, cluster)),
        post(checked(std::move(transport))),
        reports(ReportPool::create()),
        stepper(settings, std::move(scheduler), staging, *reports),
        rank(staging, post) {
    stepper.take_ghosts_from(&rank);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() = default;

  /// The id of an object in the scene of this rank, or a default id if another rank owns it.
  [[nodiscard]] ObjectId own(ObjectId object) const {
    const std::lock_guard lock(mutex);
    if (object.generation != 1) return {};
    const auto found = ids.find(object.index);
    return found == ids.end() ? ObjectId() : found->second;
  }
  /// Calls `call` with the id in the scene of this rank, if this rank owns the object.
  template <typename Call>
  void if_own(ObjectId object, const Call& call) const {
    if (const ObjectId id = own(object); id != ObjectId()) call(id);
  }
  /// A pair of an object with itself is refused by its own scene.
  void set_ignored(ObjectId a, ObjectId b, const std::optional<Ignored::Groups>& groups, bool ignored) {
    if (a == b && !groups) return if_own(a, [&](ObjectId id) { staging.set_ignored(id, id, ignored); });
    if (a.generation == 1 && b.generation == 1) rank.ignored().add({a.index, b.index, groups, ignored});
  }
  Report step(std::uint64_t tag);
  Report gather();
  /// Calls `work`, and tells the other ranks if it throws.
  template <typename Work>
  Report or_fail(const Work& work) {
    try {
      return work();
    } catch (const std::exception& problem) {
      post.fail(problem.what());
      throw;
    } catch (...) {
      post.fail("by what is no exception of the standard library");
      throw;
    }
  }

 private:
  void take_moves();
  struct PoolCloser {
    void operator()(ReportPool* pool) const { pool->close(); }
  };

 public:
  const SceneSettings settings;
  const ClusterSettings cluster;
  const std::uint64_t settings_hash;
  Post post;
  Staging staging;
  const std::unique_ptr<ReportPool, PoolCloser> reports;
  Stepper stepper;
  Rank rank;
  mutable std::mutex mutex;
  std::map<std::uint32_t, ObjectId> ids;  ///< in this rank's scene, by number. The mutex guards it
  std::vector<ObjectId> arrived;
  std::vector<ObjectId> departed;
  std::vector<Diagnostic> diagnostics;  ///< of the last step
  std::uint64_t frame = 0;
  std::uint64_t tag = 0;
  /// The layers and masks of all swept objects that were added. The mutex guards it.
  ObjectSettings swept{.layer = 0, .collides_with = 0};
};

Report Scene::State::step(std::uint64_t with_tag) {
  post.statistics = {};
  ObjectSettings added;
  {
    const std::lock_guard lock(mutex);
    stepper.collect_calls();
    added = swept;
  }
  rank.begin_step(added, settings_hash, stepper.content().store);
  const ReportHandle own = stepper.run(with_tag);
  rank.share_rows(*own);
  frame = own->frame();
  tag = with_tag;
  diagnostics.clear();
  translate(*own, rank, diagnostics);
  std::unique_ptr<FrameReport> report = report_of(rank.rows(), frame, tag);
  ReportBuilder builder(*report);
  builder.diagnostics() = diagnostics;
  StepStatistics& statistics = builder.statistics();
  statistics.work = own->statistics().work;
  statistics.bytes = own->statistics().bytes;
  statistics.times = own->statistics().times;
  statistics.objects = own->statistics().objects - rank.ghosts().count();
  post.statistics.objects = statistics.objects;
  post.statistics.ghosts = rank.ghosts().count();
  take_moves();
  return report;
}

/// Lets objects go to other ranks, and takes up which have come.
void Scene::State::take_moves() {
  arrived.clear();
  departed.clear();
  if (!cluster.max_imbalance) return;
  const FloatingPointScope scope;
  std::unique_ptr<FrameReport> previous = rank.balance(*cluster.max_imbalance, stepper.content());
  if (previous == nullptr) return;
  stepper.go_on_from(std::move(previous));
  const std::lock_guard lock(mutex);
  for (const Number number : rank.departed()) {
    ids.erase(static_cast<std::uint32_t>(number));
    departed.push_back(cluster::id_of(number));
  }
  for (const auto& [number, id] : rank.arrived()) {
    ids.emplace(static_cast<std::uint32_t>(number), id);
    arrived.push_back(cluster::id_of(number));
  }
  post.statistics.arrivals = arrived.size();
  post.statistics.departures = departed.size();
}

Report Scene::State::gather() {
  ByteBuffer given;
  ByteBuffer rows;
  for (const ClusterRow& row : rank.found()) write_row(rows, row);
  write_fields(given, diagnostics, std::uint64_t{rows.size()});
  given.append(rows.bytes());
  const auto all = post.gather(given.bytes());
  if (all.empty()) return nullptr;
  std::vector<ClusterRow> merged;
  std::vector<Diagnostic> told;
  for (const Transport::Bytes& bytes : all) {
    ByteSource source(bytes);
    std::vector<Diagnostic> of_rank;
    std::uint64_t size = 0;
    source(of_rank, size);
    std::move(of_rank.begin(), of_rank.end(), std::back_inserter(told));
    read_rows(source.take(static_cast<std::size_t>(size)), merged);
  }
  sort_rows(merged);
  std::stable_sort(told.begin(), told.end(), [](const Diagnostic& left, const Diagnostic& right) {
    return std::pair(left.object != ObjectId(), left.object) <
           std::pair(right.object != ObjectId(), right.object);
  });
  std::unique_ptr<FrameReport> report = report_of(merged, frame, tag);
  ReportBuilder(*report).diagnostics() = std::move(told);
  return report;
}

Scene::Scene(const SceneSettings& settings, std::shared_ptr<Transport> transport,
             const ClusterSettings& cluster, std::shared_ptr<TaskScheduler> scheduler)
    : state_(std::make_unique<State>(settings, std::move(transport), cluster, std::move(scheduler))) {}
Scene::~Scene() = default;

int Scene::rank() const {
  return state_->post.rank();
}
int Scene::size() const {
  return state_->post.size();
}

ObjectId Scene::add(std::uint32_t number, std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings) {
  if (settings.queries || settings.patch_radius > 0)
    throw Error("object '" + settings.name + "': a cluster does not offer queries and patches");
  AddObject call = addition_of(std::move(mesh), settings);
  call.serial = number;
  call.place = place_of_own(number);
  const std::lock_guard lock(state_->mutex);
  if (state_->ids.contains(number))
    throw Error("object '" + settings.name + "': this rank has an object of number " +
                std::to_string(number));
  if (settings.swept) {
    state_->swept.swept = true;
    state_->swept.layer |= settings.layer;
    state_->swept.collides_with |= settings.collides_with;
  }
  state_->ids.emplace(number, state_->staging.add(std::move(call)));
  return id_of(number);
}

void Scene::replace_mesh(ObjectId object, std::shared_ptr<const Mesh> mesh,
                         std::span<const std::uint32_t> new_of_old,
                         std::span<const std::uint8_t> face_groups) {
  state_->if_own(object, [&](ObjectId id) {
    state_->staging.replace_mesh(id, std::move(mesh), new_of_old, face_groups);
  });
}

void Scene::remove(ObjectId object) {
  state_->if_own(object, [&](ObjectId id) {
    state_->staging.remove(id);
    const std::lock_guard lock(state_->mutex);
    state_->ids.erase(object.index);
  });
}

bool Scene::owns(ObjectId object) const {
  return state_->own(object) != ObjectId();
}

std::vector<ObjectId> Scene::owned() const {
  const std::lock_guard lock(state_->mutex);
  std::vector<ObjectId> all;
  for (const auto& [number, id] : state_->ids) all.push_back(id_of(number));
  return all;
}

std::shared_ptr<const Mesh> Scene::mesh(ObjectId object) const {
  const auto named = state_->staging.find(state_->own(object));
  return named ? named->mesh.get().mesh : nullptr;
}

ObjectSettings Scene::object_settings(ObjectId object) const {
  const auto named = state_->staging.find(state_->own(object));
  return named ? named->settings : ObjectSettings();
}

void Scene::set_pose_rows(ObjectId object, const std::array<double, 12>& rows) {
  state_->if_own(object, [&](ObjectId id) { state_->staging.set_pose(id, rows); });
}
void Scene::set_pose_rows(ObjectId object, const std::array<double, 12>& rows, Teleport) {
  state_->if_own(object, [&](ObjectId id) { state_->staging.set_pose(id, rows, true); });
}
void Scene::set_pose_matrix(ObjectId object, const std::array<double, 16>& rows) {
  state_->if_own(object, [&](ObjectId id) { state_->staging.set_pose(id, rows); });
}
void Scene::set_positions(ObjectId object, PositionView positions) {
  state_->if_own(object, [&](ObjectId id) {
    state_->staging.set_positions(id, positions, graze::Scene::any_displacement);
  });
}
void Scene::set_positions(ObjectId object, PositionView positions, Teleport) {
  state_->if_own(object, [&](ObjectId id) {
    state_->staging.set_positions(id, positions, graze::Scene::any_displacement, true);
  });
}
void Scene::bind_positions(ObjectId object, PositionView positions, BindPolicy policy) {
  state_->if_own(object, [&](ObjectId id) { state_->staging.bind_positions(id, positions, policy); });
}
void Scene::unbind_positions(ObjectId object) {
  state_->if_own(object, [&](ObjectId id) { state_->staging.unbind_positions(id); });
}
void Scene::positions_changed(ObjectId object) {
  state_->if_own(object,
                 [&](ObjectId id) { state_->staging.positions_changed(id, graze::Scene::any_displacement); });
}
void Scene::positions_changed(ObjectId object, Teleport) {
  state_->if_own(object, [&](ObjectId id) {
    state_->staging.positions_changed(id, graze::Scene::any_displacement, true);
  });
}

void Scene::ignore(ObjectId a, ObjectId b) {
  state_->set_ignored(a, b, {}, true);
}
void Scene::watch(ObjectId a, ObjectId b) {
  state_->set_ignored(a, b, {}, false);
}
void Scene::ignore(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b) {
  state_->set_ignored(a, b, Ignored::Groups{group_a, group_b}, true);
}
void Scene::watch(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b) {
  state_->set_ignored(a, b, Ignored::Groups{group_a, group_b}, false);
}
void Scene::set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule) {
  state_->staging.set_rule(kind_a, kind_b, rule);
}
void Scene::reserve(const SceneCapacity& capacity) {
  state_->staging.reserve(capacity);
}

Report Scene::step(std::uint64_t tag) {
  return state_->or_fail([&] { return state_->step(tag); });
}

Report Scene::gather() {
  return state_->or_fail([&] { return state_->gather(); });
}
const ClusterStatistics& Scene::statistics() const {
  return state_->post.statistics;
}
std::span<const ObjectId> Scene::arrived() const {
  return state_->arrived;
}
std::span<const ObjectId> Scene::departed() const {
  return state_->departed;
}

}  // namespace graze::cluster
