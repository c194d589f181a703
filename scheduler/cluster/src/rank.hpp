#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "borders.hpp"
#include "calls/staging.hpp"
#include "ghosts.hpp"
#include "ignored.hpp"
#include "messages.hpp"
#include "post.hpp"
#include "rows.hpp"
#include "step/ghost_source.hpp"
#include "step/scene_content.hpp"

namespace graze::cluster {

/// The part of a rank beside its own scene. In each step it tells other ranks of its objects, and brings
/// theirs as ghosts. Stepping thread only.
class Rank final : public GhostSource {
 public:
  Rank(Staging& staging, Post& post)
      : staging_(staging), post_(post), borders_(post.rank()), ghosts_(staging, post.rank()) {}

  /// Begins a step, before anything is read. `added` has what the swept objects that were added here have
  /// together, and the hash is of settings that all ranks have alike. Throws Error if ranks differ.
  void begin_step(const ObjectSettings& added, std::uint64_t settings_hash, ObjectStore& store);
  void bring(ObjectStore& store, PairFilter& filter, TaskPool& tasks) override;

  /// Takes up the rows of the step that has just run, gives those of other ranks' objects to them, and takes
  /// theirs.
  void share_rows(const FrameReport& report);
  /// Lets objects go to other ranks if the load of one is more than that many times the mean. Call it after
  /// share_rows(). If any did, it returns the report that the next step goes on from, and otherwise null.
  [[nodiscard]] std::unique_ptr<FrameReport> balance(double max_imbalance, SceneContent& content);
  /// The objects that came and went by the last `balance`, by the ids of this rank's scene and their numbers.
  [[nodiscard]] std::span<const std::pair<Number, ObjectId>> arrived() const { return arrived_; }
  [[nodiscard]] std::span<const Number> departed() const { return departed_; }
  /// The rows that this rank has found, in order.
  [[nodiscard]] std::span<const ClusterRow> found() const { return found_; }
  /// All rows of objects of this rank, in order.
  [[nodiscard]] std::span<const ClusterRow> rows() const { return rows_; }
  /// The number of an object of the rank's scene, also of one that was dropped in the last step.
  [[nodiscard]] std::optional<Number> number_of(ObjectId id) const;
  [[nodiscard]] const Ghosts& ghosts() const { return ghosts_; }
  [[nodiscard]] Ignored& ignored() { return ignored_; }

 private:
  void list_own();
  void bound_own(const PairFilter& filter);
  void agree();
  void find_neighbours();
  void exchange_boxes();
  [[nodiscard]] std::vector<Object*> to_be_ghosts_at(int rank);
  [[nodiscard]] std::vector<Object*> own_of(const std::set<Number>& wanted) const;
  void read_unread(std::span<Object* const> objects, TaskPool& tasks);
  void exchange_ghosts(Post::Kind kind, std::span<const int> ranks,
                       const std::map<int, std::vector<Object*>>& ghosts, PairFilter& filter,
                       TaskPool& tasks);
  void bring_near(PairFilter& filter, TaskPool& tasks);
  void keep_poses();
  void take_up_rows(int rank, std::span<const std::byte> message);

  // These are in balance.cpp.
  [[nodiscard]] bool is_own(Number number) const;
  void count_loads();
  [[nodiscard]] bool is_unbalanced(double max_imbalance) const;
  [[nodiscard]] std::map<Number, int> agreed_moves();
  void write_moving_objects(const std::map<Number, int>& moves, TaskPool& tasks,
                            std::vector<ByteBuffer>& messages);
  void write_moving_rows(const std::map<Number, int>& moves, std::vector<ByteBuffer>& messages);
  void leave(Number number, const std::map<Number, int>& moves, PairFilter& filter);
  [[nodiscard]] std::vector<ClusterRow> keep_rows(const std::map<Number, int>& moves);
  void take_over(std::span<const std::byte> message, SceneContent& content, std::vector<ClusterRow>& rows);
  void take_over_objects(ByteSource& source, SceneContent& content);
  void take_over_row(const MovingRow& ranks, ClusterRow row, std::vector<ClusterRow>& adopted);
  void bring_listed(SceneContent& content);
  [[nodiscard]] int rank_of(Number number) const;
  [[nodiscard]] std::vector<int> others() const;
  [[nodiscard]] std::unique_ptr<FrameReport> report_by_own_ids(std::span<const ClusterRow> rows) const;

  Staging& staging_;
  Post& post_;
  Borders borders_;
  Ghosts ghosts_;
  GhostSender sender_;
  Ignored ignored_;
  ObjectStore* store_ = nullptr;
  std::vector<Object*> own_;  ///< ascending by number
  std::uint64_t stepped_ = 0;
  std::uint64_t load_ = 0;    ///< of the last step, in nanoseconds
  std::vector<Box> extents_;  ///< by rank
  Box all_objects_;
  std::vector<int> neighbours_;                  ///< ascending
  std::map<int, std::set<Number>> listed_with_;  ///< own objects in rows that a rank has found last
  std::map<Number, std::array<double, 12>> last_poses_;
  std::map<ObjectId, Number> gone_;  ///< objects that were dropped in the last step
  std::vector<ClusterRow> found_;
  std::vector<ClusterRow> rows_;
  std::map<Number, int> places_;      ///< the ranks of all objects in `rows_` that other ranks own
  std::vector<std::uint64_t> loads_;  ///< by rank, of the step before the last
  std::uint64_t moved_in_step_ = 0;   ///< the last in which objects went to other ranks
  std::vector<std::pair<Number, ObjectId>> arrived_;
  std::vector<Number> departed_;
};

}  // namespace graze::cluster
