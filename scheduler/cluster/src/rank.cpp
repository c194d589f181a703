#include "rank.hpp"

#include <algorithm>
#include <graze/error.hpp>
#include <numeric>
#include <string>
#include <utility>

namespace graze::cluster {

void Rank::bring(ObjectStore& store, PairFilter& filter, TaskPool& tasks) {
  store_ = &store;
  ghosts_.begin_step();
  ignored_.take_up(store, filter);
  list_own();
  bound_own(filter);
  agree();
  find_neighbours();
  exchange_boxes();
  bring_near(filter, tasks);
  keep_poses();
  gone_.clear();
  for (const DepartedObject& departed : store.departed()) gone_.emplace(departed.id, departed.serial);
}

/// Lists the objects that the rank owns.
void Rank::list_own() {
  own_.clear();
  for (const auto& object : store_->objects())
    if (!is_ghost(*object)) own_.push_back(object.get());
}

/// Makes the boxes outside of which no pair of an own object can be near.
void Rank::bound_own(const PairFilter& filter) {
  std::vector<OwnBox> boxes;
  boxes.reserve(own_.size());
  for (const Object* const object : own_) {
    Box box = object->box;
    if (store_->swept().some() && store_->swept().moves(*object)) box.add(object->sweep->motion.start_box());
    const double reach = filter.half_reaches()[object->settings.kind] + object->settings.margin;
    FilterTraits traits = filter_traits_of(*object);
    traits.place = {};
    boxes.push_back({object->serial, grown(box, reach + filter.swept_gap()), traits});
  }
  borders_.begin_step(boxes);
}

/// Finds out what all ranks have to agree on before they read. In a scene where an object is swept, the
/// objects of all ranks keep where they were.
void Rank::begin_step(const ObjectSettings& added, std::uint64_t settings_hash, ObjectStore& store) {
  const StepNote mine{settings_hash, ++stepped_, added.layer, added.collides_with, added.swept};
  ByteBuffer given;
  write_fields(given, mine);
  ObjectSettings swept{.layer = 0, .collides_with = 0};
  for (const Transport::Bytes& bytes : post_.all_gather(&ClusterStatistics::bytes_boxes, given.bytes())) {
    StepNote note;
    ByteSource source(bytes);
    source(note);
    if (note.stepped != mine.stepped)
      throw Error("the ranks of a cluster do not step together: one is in step " +
                  std::to_string(note.stepped) + ", and this one in step " + std::to_string(mine.stepped));
    if (note.settings_hash != mine.settings_hash)
      throw Error("the ranks of a cluster have different settings");
    swept.layer |= note.swept_layers;
    swept.collides_with |= note.swept_masks;
    swept.swept = swept.swept || note.some_swept;
  }
  if (swept.swept) (void)store.take_up_sweep(swept);
}

/// Tells all ranks where the objects are, and takes up what they tell.
void Rank::agree() {
  RankNote mine;
  mine.extent = numbers_of(borders_.extent());
  Box objects;
  for (const Object* const object : own_) objects.add(object->box);
  mine.objects = numbers_of(objects);
  mine.load = load_;
  for (const DepartedObject& departed : store_->departed()) mine.removed.push_back(departed.serial);
  ByteBuffer given;
  write_fields(given, mine);
  extents_.clear();
  all_objects_ = {};
  loads_.clear();
  for (const Transport::Bytes& bytes : post_.all_gather(&ClusterStatistics::bytes_boxes, given.bytes())) {
    RankNote note;
    ByteSource source(bytes);
    source(note);
    extents_.push_back(box_of(note.extent));
    if (const Box objects_there = box_of(note.objects); !objects_there.empty())
      all_objects_.add(objects_there);
    loads_.push_back(note.load);
    for (const Number number : note.removed) ignored_.forget(number);
  }
  const std::uint64_t all = std::accumulate(loads_.begin(), loads_.end(), std::uint64_t{0});
  const std::uint64_t most = *std::max_element(loads_.begin(), loads_.end());
  const double mean = static_cast<double>(all) / static_cast<double>(loads_.size());
  post_.statistics.imbalance = all == 0 ? 1 : static_cast<double>(most) / mean;
}

/// Two ranks are neighbours if pairs of their objects may be near, or if one has a ghost of the other.
void Rank::find_neighbours() {
  const Box& mine = extents_[static_cast<std::size_t>(post_.rank())];
  neighbours_.clear();
  for (int rank = 0; rank < post_.size(); ++rank) {
    if (rank == post_.rank()) continue;
    if (do_meet(mine, extents_[static_cast<std::size_t>(rank)]) || ghosts_.some_of(rank) ||
        sender_.some_at(rank))
      neighbours_.push_back(rank);
    else
      borders_.part_from(rank);
  }
  post_.statistics.neighbours = neighbours_.size();
}

void Rank::exchange_boxes() {
  const auto tell = [&](int rank, ByteBuffer& message) {
    borders_.tell(rank, extents_[static_cast<std::size_t>(rank)], message);
  };
  const auto heard = post_.exchange(&ClusterStatistics::bytes_boxes, neighbours_, tell);
  for (std::size_t i = 0; i < heard.size(); ++i) borders_.hear(neighbours_[i], heard[i]);
}

/// A pair that the last report has listed stays where it is, however far apart it is: it has to be listed
/// once more, or its object is frozen.
std::vector<Object*> Rank::to_be_ghosts_at(int rank) {
  std::set<Number> wanted = borders_.wanted_by(rank);
  if (const auto listed = listed_with_.find(rank); listed != listed_with_.end())
    wanted.insert(listed->second.begin(), listed->second.end());
  return own_of(wanted);
}

/// The own objects of these numbers.
std::vector<Object*> Rank::own_of(const std::set<Number>& wanted) const {
  std::vector<Object*> objects;
  auto next = wanted.begin();
  for (Object* const object : own_) {
    while (next != wanted.end() && *next < object->serial) ++next;
    if (next != wanted.end() && *next == object->serial) objects.push_back(object);
  }
  return objects;
}

void Rank::read_unread(std::span<Object* const> objects, TaskPool& tasks) {
  std::vector<Object*> wanted;
  for (Object* const object : objects)
    if (object->is_unread() && std::exchange(object->plan, ReadPlan::read) == ReadPlan::skip)
      wanted.push_back(object);
  std::vector<Diagnostic> problems;  // a survey has found them already
  if (!wanted.empty()) store_->read_unread(wanted, tasks, problems);
}

/// Tells each rank of its ghosts, and brings those of this rank to where their ranks say. `ghosts` are by
/// rank. All are read before any is told of, since an object may be a ghost in several ranks.
void Rank::exchange_ghosts(Post::Kind kind, std::span<const int> ranks,
                           const std::map<int, std::vector<Object*>>& ghosts, PairFilter& filter,
                           TaskPool& tasks) {
  for (const auto& [rank, objects] : ghosts) read_unread(objects, tasks);
  const auto tell = [&](int rank, ByteBuffer& message) {
    sender_.tell(rank, ghosts.at(rank), *store_, last_poses_, message);
  };
  const auto heard = post_.exchange(kind, ranks, tell);
  // The messages stay until the ghosts are read, since positions are read from them.
  for (std::size_t i = 0; i < heard.size(); ++i) ghosts_.hear(ranks[i], heard[i], *store_, filter);
  ghosts_.read(*store_, filter, ignored_, tasks);
}

/// Brings the ghosts of all pairs that may be near.
void Rank::bring_near(PairFilter& filter, TaskPool& tasks) {
  std::map<int, std::vector<Object*>> ghosts;
  for (const int rank : neighbours_) ghosts[rank] = to_be_ghosts_at(rank);
  exchange_ghosts(&ClusterStatistics::bytes_positions, neighbours_, ghosts, filter, tasks);
  const std::uint64_t of_meshes = sender_.take_mesh_bytes();
  post_.statistics.bytes_positions -= of_meshes;
  post_.statistics.bytes_meshes += of_meshes;
}

/// Keeps where posed objects in swept pairs stand, for ranks to which they come in the next step.
void Rank::keep_poses() {
  last_poses_.clear();
  for (const Object* const object : own_)
    if (object->sweep != nullptr && object->standing_pose)
      last_poses_.emplace_hint(last_poses_.end(), object->serial, *object->standing_pose);
}

std::optional<Number> Rank::number_of(ObjectId id) const {
  if (const Object* const object = store_->find(id)) return object->serial;
  const auto gone = gone_.find(id);
  return gone == gone_.end() ? std::optional<Number>() : gone->second;
}

bool Rank::is_own(Number number) const {
  const Object* const object = store_->find_serial(number);
  return object != nullptr && !is_ghost(*object);
}

void Rank::share_rows(const FrameReport& report) {
  std::map<int, ByteBuffer> for_others;
  found_.clear();
  places_.clear();
  listed_with_.clear();
  for (const PairReport& pair : report.pairs()) {
    const Number a = *number_of(pair.a);
    const Number b = *number_of(pair.b);
    const ClusterRow& row = found_.emplace_back(row_of(report, pair, id_of(a), id_of(b)));
    for (const Number number : {a, b}) {
      const int rank = ghosts_.rank_of(number);
      if (rank < 0) continue;
      places_[number] = rank;
      write_row(for_others[rank], row);
    }
  }
  const auto tell = [&](int rank, ByteBuffer& message) { message.append(for_others[rank].bytes()); };
  const auto heard = post_.exchange(&ClusterStatistics::bytes_contacts, neighbours_, tell);
  rows_ = found_;
  for (std::size_t i = 0; i < heard.size(); ++i) take_up_rows(neighbours_[i], heard[i]);
  sort_rows(rows_);
  count_loads();
}

/// Takes up the rows that another rank has found with objects of this one.
void Rank::take_up_rows(int rank, std::span<const std::byte> message) {
  const std::size_t before = rows_.size();
  read_rows(message, rows_);
  for (const ClusterRow& row : std::span(rows_).subspan(before))
    for (const Number number : {row.a(), row.b()})
      if (is_own(number))
        listed_with_[rank].insert(number);
      else
        places_[number] = rank;
}

}  // namespace graze::cluster
