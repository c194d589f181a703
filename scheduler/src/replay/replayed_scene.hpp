#pragma once

#include <cstdint>
#include <graze/recording.hpp>
#include <graze/scene.hpp>
#include <map>
#include <unordered_map>
#include <vector>

#include "calls/staging.hpp"
#include "recording/records.hpp"
#include "recording/scene_model.hpp"
#include "replay/known_filters.hpp"
#include "replay/recording_reader.hpp"

namespace graze {

/// A scene that is given what records tell, which have passed RecordCheck. So the scene takes all of it up,
/// and what is kept here of an object is what the scene has. Ids of the recording become ids of this scene.
class ReplayedScene {
 public:
  /// `staging` is that of `scene`.
  ReplayedScene(const RecordingReader& reader, Scene& scene, Staging& staging)
      : reader_(reader), scene_(scene), staging_(staging), least_range_(scene.settings().range) {}

  void apply(const Record& record) {
    std::visit([this](const auto& one) { take(one); }, record);
  }
  /// The recorded id of an object of this scene, also of one that the last step removed.
  [[nodiscard]] ObjectId recorded_id(ObjectId id) const;
  /// The least range that a pair has had so far. A pair below it is listed.
  [[nodiscard]] double least_range() const { return least_range_; }
  /// A name for people of an object, by its recorded id.
  [[nodiscard]] std::string name_of(ObjectId recorded) const;
  /// The objects, in the order of addition.
  [[nodiscard]] std::vector<ReplayObject> objects() const;
  /// Returns what was said of pairs, as KnownFilters::all() does.
  [[nodiscard]] std::shared_ptr<const PairFilters> pair_filters() { return filters_.all(); }
  void read_positions(ObjectId id, std::vector<Eigen::Vector3d>& positions) const;
  [[nodiscard]] std::array<double, 12> pose(ObjectId id) const;
  /// Forgets the objects that were removed before the last step.
  void forget_removed();

 private:
  struct Object {
    ReplayObject object;
    ObjectId recorded;
    std::array<double, 12> pose{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    KeptPositions positions;  ///< what it is bound to, or what it was given last. It is empty at rest
    BindPolicy policy = BindPolicy::every_step;
    bool is_told = false;  ///< the scene knows of new memory, and has not been seen to read it
    bool is_removed = false;
  };
  [[nodiscard]] Object* find(ObjectId recorded);
  /// The id in this scene. A default id where there is none.
  [[nodiscard]] ObjectId id_of(ObjectId recorded);
  [[nodiscard]] const Object& of(ObjectId id) const;

  void take(const AddRecord& record);
  void take(const ReplaceRecord& record);
  void take(const RemoveObject& record);
  void take(const SetPose& record);
  void take(const RefusePose& record);
  void take(const SettlePose& record);
  void take(const PositionsRecord& record);
  void take(const BindRecord& record);
  void take(const MemoryRecord& record);
  void take(const UnbindRecord& record);
  void take(const PositionsChanged& record);
  void take(const MarkTeleport& record);
  void take(const IgnorePair& record);
  void take(const IgnoreGroups& record);
  void take(const SetRule& record);
  void take(const Reserve&) {}  // memory is no part of an answer
  void take(const Diagnostic& record);

  const RecordingReader& reader_;
  Scene& scene_;
  Staging& staging_;
  double least_range_;
  std::map<std::uint64_t, Object> objects_;               ///< by serial
  std::unordered_map<ObjectId, std::uint64_t> recorded_;  ///< serials, by recorded id
  std::unordered_map<ObjectId, std::uint64_t> replayed_;  ///< serials, by the id in this scene
  KnownFilters filters_;                                  ///< by ids in this scene
  std::vector<ObjectId> removed_;                         ///< recorded ids
};

}  // namespace graze
