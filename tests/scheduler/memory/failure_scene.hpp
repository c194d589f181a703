#pragma once

#include <array>
#include <cstddef>
#include <graze/graze.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scheduler/scene_support.hpp"

namespace graze::tests {

/// The stories of the scenes in which memory runs out.
enum class FailureStory {
  copied,       ///< positions are copied, with and without promises
  bound,        ///< memory is bound, in float and double. Bindings end in every way, and then it is freed
  told,         ///< bound memory is read when told, with promises
  posed,        ///< rigid bodies over a fixed one, one by one and in a batch
  come_and_go,  ///< in every way of moving. One goes, one comes
  filters,      ///< pairs and rules change, and calls are bad
  reserved,     ///< room is reserved, and reports are held
  large,        ///< two surfaces that are cut into slices, and distances of regions
  async,        ///< steps on another thread, calls meanwhile
  budgets,      ///< that do not run out
  replaced,     ///< copied and posed bodies get other meshes, each with a face less
};
inline constexpr std::size_t story_count = 11;

/// Bodies that move through each other, and what happens to them. All that is told was calculated before, so
/// that only graze takes memory while a frame is played.
class FailureScene {
 public:
  static constexpr std::size_t frame_count = 5;
  enum class Given { copied, bound, told, posed, fixed };
  struct Body {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const Mesh> next_mesh;  ///< the one that replaces it, null if none does
    std::vector<std::uint32_t> same_vertices;
    Given given = Given::copied;
    bool is_float = false;
    std::vector<Eigen::Isometry3d> poses;              ///< by frame
    std::vector<Positions> positions;                  ///< by frame, as they are in float where that is given
    std::vector<std::vector<Eigen::Vector3f>> floats;  ///< by frame
    std::vector<double> promises;                      ///< by frame: how far any vertex moved since the last
  };

  /// `event` is the frame in which what the story tells of happens.
  FailureScene(FailureStory story, std::size_t event);

  [[nodiscard]] FailureStory story() const { return story_; }
  [[nodiscard]] std::size_t event() const { return event_; }
  [[nodiscard]] SceneSettings settings(ContactDetail detail, unsigned threads) const;
  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }
  /// Whether a body is there in a frame.
  [[nodiscard]] bool is_there(std::size_t body, std::size_t frame) const;
  [[nodiscard]] bool has_filters(std::size_t frame) const {
    return story_ == FailureStory::filters && frame >= event_;
  }
  /// The mesh of a body from a frame on.
  [[nodiscard]] const std::shared_ptr<const Mesh>& mesh(std::size_t body, std::size_t frame) const {
    const Body& told = bodies_[body];
    return told.next_mesh != nullptr && frame >= event_ ? told.next_mesh : told.mesh;
  }
  /// How a body is moved from a frame on.
  [[nodiscard]] Given given(std::size_t body, std::size_t frame) const;

  static constexpr std::uint32_t ruled_kind = 1;
  [[nodiscard]] static PairRule rule() { return {0.2, 0.6, {}}; }

 private:
  void add_body(const std::shared_ptr<const Mesh>& mesh, Given given, double spread);

  FailureStory story_;
  std::size_t event_;
  std::vector<Body> bodies_;
};

/// A scene that plays it.
class FailurePlay {
 public:
  FailurePlay(const FailureScene& story, const SceneSettings& settings);

  /// All calls of a frame. Again and again they say all that is so. Throws what `add` and `reserve` throw.
  void tell(std::size_t frame);
  ReportHandle step(std::size_t frame);

  [[nodiscard]] Scene& scene() { return *scene_; }
  [[nodiscard]] bool scene_contains(ObjectId id) const { return scene_->contains(id); }
  /// Which body an object is, or none if it is not there.
  [[nodiscard]] std::optional<std::size_t> body_of(ObjectId id) const;
  /// Ends the scene before its time.
  void end() { scene_.reset(); }

 private:
  struct Told {
    std::optional<ObjectId> id;
    bool is_replaced = false;
    // The bound memory: one of the two is in use.
    std::unique_ptr<Positions> doubles;
    std::unique_ptr<std::vector<Eigen::Vector3f>> floats;
    std::unique_ptr<Positions> next_doubles;  ///< for another binding
  };
  void add(std::size_t body);
  void replace(std::size_t body);
  void tell_event();
  void tell_filters(std::size_t frame);
  void write(std::size_t body, std::size_t frame);
  [[nodiscard]] PositionView memory(std::size_t body) const;
  void place(std::size_t body, std::size_t frame);

  const FailureScene& story_;
  std::unique_ptr<Scene> scene_;
  std::vector<Told> told_;
  std::vector<ObjectId> batch_;
  std::vector<Eigen::Isometry3d> batch_poses_;
  std::array<ReportHandle, 3> held_;
};

/// The report of a scene of these bodies that is built afresh for one frame.
class FreshReport {
 public:
  FreshReport(const FailureScene& story, SceneSettings settings, std::size_t frame);

  /// The first difference from a report of a play, of which `before` was the one published before. Empty
  /// where there is none.
  [[nodiscard]] std::string difference_from(const FailurePlay& play, const FrameReport& report,
                                            const FrameReport& before) const;

 private:
  /// A pair by its bodies, the one that was added first first.
  struct Row {
    std::size_t a = 0, b = 0;
    bool in_contact = false;
    std::vector<double> numbers;  ///< of bounds, witness and contacts
  };
  static Row row_of(const FrameReport& report, const PairReport& pair, std::size_t a, std::size_t b);

  std::vector<Row> rows_;
};

}  // namespace graze::tests
