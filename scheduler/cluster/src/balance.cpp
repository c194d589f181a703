#include <algorithm>

#include "borders.hpp"
#include "division.hpp"
#include "rank.hpp"
#include "report/report_builder.hpp"

// How objects go to other ranks, between two steps. An object leaves every scene that has it, as its own or
// as a ghost, and comes anew where it is wanted. The rows of its pairs go with it, since the next step has to
// know which pairs were in contact, and since when.

namespace graze::cluster {
namespace {

// Estimates of how long things take, which are the same in every run.
constexpr std::uint64_t nanoseconds_each_vertex = 5;
constexpr std::uint64_t nanoseconds_each_row = 3000;
constexpr std::uint64_t nanoseconds_each_contact = 500;

/// Steps from one balancing to the next. It moves as much as several steps do.
constexpr std::uint64_t steps_between = 8;

std::uint64_t nanoseconds_of(const ClusterRow& row) {
  return nanoseconds_each_row + nanoseconds_each_contact * row.contacts.size();
}

Eigen::Vector3d middle_of(const Box& box) {
  return box.min / 2 + box.max / 2;
}

}  // namespace

/// The load of this rank is of the pairs that it has, whose objects they are.
void Rank::count_loads() {
  load_ = 0;
  for (const Object* const object : own_) load_ += nanoseconds_each_vertex * object->mesh->vertex_count();
  for (const ClusterRow& row : found_) load_ += nanoseconds_of(row);
  post_.statistics.load = static_cast<double>(load_) * 1e-6;
}

bool Rank::is_unbalanced(double max_imbalance) const {
  return post_.size() > 1 && post_.statistics.imbalance > max_imbalance &&
         stepped_ - moved_in_step_ >= steps_between;
}

/// All ranks get the same answer: the rank to which each object goes.
std::map<Number, int> Rank::agreed_moves() {
  std::map<Number, std::uint64_t> of_rows;
  for (const ClusterRow& row : rows_)
    for (const Number number : {row.a(), row.b()}) of_rows[number] += nanoseconds_of(row) / 2;
  std::vector<Load> loads;
  for (const Object* const object : own_) {
    const auto rows = of_rows.find(object->serial);
    loads.push_back({middle_of(object->box), nanoseconds_each_vertex * object->mesh->vertex_count() +
                                                 (rows == of_rows.end() ? 0 : rows->second)});
  }
  const std::vector<int> ranks = divided(loads, all_objects_, post_);
  ByteBuffer given;
  for (std::size_t i = 0; i < own_.size(); ++i)
    if (ranks[i] != post_.rank()) write_fields(given, Move{own_[i]->serial, ranks[i]});
  std::map<Number, int> moves;
  for (const Transport::Bytes& bytes : post_.all_gather(&ClusterStatistics::bytes_moves, given.bytes())) {
    ByteSource source(bytes);
    while (source.at() < bytes.size()) {
      Move move;
      source(move);
      moves.emplace(move.number, move.to);
    }
  }
  return moves;
}

int Rank::rank_of(Number number) const {
  const auto found = places_.find(number);
  return found == places_.end() ? post_.rank() : found->second;
}

/// Each message has its meshes once.
void Rank::write_moving_objects(const std::map<Number, int>& moves, TaskPool& tasks,
                                std::vector<ByteBuffer>& messages) {
  std::vector<std::vector<Object*>> for_rank(messages.size());
  for (Object* const object : own_)
    if (const auto move = moves.find(object->serial); move != moves.end())
      for_rank[static_cast<std::size_t>(move->second)].push_back(object);
  for (std::size_t rank = 0; rank < messages.size(); ++rank) {
    read_unread(for_rank[rank], tasks);  // what was only surveyed has older positions in its surface
    std::map<const IndexedMesh*, std::uint64_t> meshes;
    std::vector<MeshChunk> chunks;
    for (const Object* const object : for_rank[rank])
      if (meshes.emplace(object->mesh, chunks.size()).second) chunks.push_back(mesh_chunk_of(*object->mesh));
    write_fields(messages[rank], chunks, std::uint64_t{for_rank[rank].size()});
    for (const Object* const object : for_rank[rank])
      write_fields(messages[rank],
                   MovingObject{state_of(*object, *store_), object->settings, meshes.at(object->mesh)},
                   ignored_.of(object->serial));
  }
}

/// A row is sent by the rank that has owned its first object that goes. Both ranks get it that own its
/// objects then.
void Rank::write_moving_rows(const std::map<Number, int>& moves, std::vector<ByteBuffer>& messages) {
  for (const ClusterRow& row : rows_) {
    const auto of_a = moves.find(row.a());
    const auto of_b = moves.find(row.b());
    const Number first = of_a != moves.end() ? row.a() : row.b();
    if ((of_a == moves.end() && of_b == moves.end()) || !is_own(first)) continue;
    const MovingRow ranks{of_a != moves.end() ? of_a->second : rank_of(row.a()),
                          of_b != moves.end() ? of_b->second : rank_of(row.b())};
    for (const int rank : std::set<int>{ranks.rank_of_a, ranks.rank_of_b}) {
      ByteBuffer& message = messages[static_cast<std::size_t>(rank)];
      write_fields(message, ranks);
      write_row(message, row);
    }
  }
}

/// Takes an object out of this rank's scene, in which it is a ghost, or was its own.
void Rank::leave(Number number, const std::map<Number, int>& moves, PairFilter& filter) {
  if (ghosts_.has(number)) return ghosts_.drop(number, *store_, filter);
  if (!is_own(number)) return;
  Object* const object = store_->find(store_->find_serial(number)->id);
  const ObjectId id = object->id;
  sender_.forget(number);
  filter.forget(*object);
  ignored_.leave(number, [&](Number other) { return is_own(other) && !moves.contains(other); });
  last_poses_.erase(number);
  store_->apply(RemoveObject{id});
  staging_.forget_ghost(id);
  departed_.push_back(number);
}

void Rank::take_over_row(const MovingRow& ranks, ClusterRow row, std::vector<ClusterRow>& adopted) {
  const Number a = row.a();
  const Number b = row.b();
  const int rank = rank_of_pair(a, ranks.rank_of_a, b, ranks.rank_of_b);
  if (rank == post_.rank()) return adopted.push_back(std::move(row));
  if (ranks.rank_of_a == post_.rank()) listed_with_[rank].insert(a);
  if (ranks.rank_of_b == post_.rank()) listed_with_[rank].insert(b);
}

/// Takes up the objects of a message.
void Rank::take_over_objects(ByteSource& source, SceneContent& content) {
  std::vector<MeshChunk> chunks;
  std::uint64_t count = 0;
  source(chunks, count);
  std::vector<std::shared_ptr<const Mesh>> meshes;
  meshes.reserve(chunks.size());
  for (const MeshChunk& chunk : chunks) meshes.push_back(std::make_shared<const Mesh>(mesh_in(chunk)));
  std::vector<MovingObject> moving(static_cast<std::size_t>(count));
  std::vector<Ignored::Call> calls;
  for (MovingObject& each : moving) {
    std::vector<Ignored::Call> of_object;
    source(each, of_object);
    calls.insert(calls.end(), of_object.begin(), of_object.end());
  }
  const std::vector<Object*> objects = ghosts_.take_over(moving, meshes, *store_, content.tasks);
  for (const Ignored::Call& call : calls) ignored_.learn(call);
  for (const Object* const object : objects) {
    ignored_.apply_to(object->serial, *store_, content.filter);
    arrived_.emplace_back(object->serial, object->id);
    if (object->standing_pose) last_poses_[object->serial] = *object->standing_pose;
  }
}

/// Keeps the rows of which no object goes: returns those that this rank has, and notes with which rank the
/// others are listed.
std::vector<ClusterRow> Rank::keep_rows(const std::map<Number, int>& moves) {
  listed_with_.clear();
  std::vector<ClusterRow> kept;
  for (const ClusterRow& row : rows_)
    if (!moves.contains(row.a()) && !moves.contains(row.b()))
      take_over_row({rank_of(row.a()), rank_of(row.b())}, row, kept);
  return kept;
}

/// Takes up the objects that come, and the rows.
void Rank::take_over(std::span<const std::byte> message, SceneContent& content,
                     std::vector<ClusterRow>& rows) {
  ByteSource source(message);
  take_over_objects(source, content);
  while (source.at() < message.size()) {
    MovingRow ranks;
    source(ranks);
    take_over_row(ranks, read_row(source), rows);
  }
}

/// Brings the ghosts of all pairs that were listed at once, so that the next step finds them in its last
/// report.
void Rank::bring_listed(SceneContent& content) {
  list_own();
  std::map<int, std::vector<Object*>> ghosts;
  for (const int rank : others()) {
    std::set<Number> wanted = listed_with_[rank];
    for (const Number number : sender_.ghosts_at(rank)) wanted.insert(number);
    ghosts[rank] = own_of(wanted);
  }
  exchange_ghosts(&ClusterStatistics::bytes_moves, others(), ghosts, content.filter, content.tasks);
  (void)sender_.take_mesh_bytes();
}

std::vector<int> Rank::others() const {
  std::vector<int> ranks;
  for (int rank = 0; rank < post_.size(); ++rank)
    if (rank != post_.rank()) ranks.push_back(rank);
  return ranks;
}

/// The report of rows by the ids of this rank's scene. Rows of an object that was removed have ended already,
/// and are left out.
std::unique_ptr<FrameReport> Rank::report_by_own_ids(std::span<const ClusterRow> rows) const {
  std::vector<ClusterRow> renamed;
  for (const ClusterRow& row : rows) {
    const Object* const a = store_->find_serial(row.a());
    const Object* const b = store_->find_serial(row.b());
    if (a == nullptr || b == nullptr) continue;
    renamed.push_back(row);
    renamed.back().pair.a = a->id;
    renamed.back().pair.b = b->id;
  }
  return report_of(renamed, stepped_, 0);
}

std::unique_ptr<FrameReport> Rank::balance(double max_imbalance, SceneContent& content) {
  arrived_.clear();
  departed_.clear();
  if (!is_unbalanced(max_imbalance)) return nullptr;
  moved_in_step_ = stepped_;
  const std::map<Number, int> moves = agreed_moves();
  if (moves.empty()) return nullptr;
  std::vector<ByteBuffer> written(static_cast<std::size_t>(post_.size()));
  write_moving_objects(moves, content.tasks, written);
  write_moving_rows(moves, written);
  std::vector<ClusterRow> rows = keep_rows(moves);
  for (const auto& [number, to] : moves) leave(number, moves, content.filter);
  store_->sort_ghosts();
  const auto tell = [&](int rank, ByteBuffer& message) {
    message.append(written[static_cast<std::size_t>(rank)].bytes());
  };
  for (const Transport::Bytes& message : post_.exchange(&ClusterStatistics::bytes_moves, others(), tell))
    take_over(message, content, rows);
  // Rows of which both objects are this rank's from now on.
  take_over(written[static_cast<std::size_t>(post_.rank())].bytes(), content, rows);
  std::sort(arrived_.begin(), arrived_.end());
  sort_rows(rows);
  borders_.forget_all();
  bring_listed(content);
  store_->forget_departed();  // no row that the next step sees is of those
  return report_by_own_ids(rows);
}

}  // namespace graze::cluster
