#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <graze/scene.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace graze::fuzz {

using Positions = std::vector<Eigen::Vector3d>;
using PoseRows = std::array<double, 12>;

/// An object of the scene as the contract says it is.
struct ModelBody {
  ObjectId id;
  std::shared_ptr<const Mesh> mesh;
  ObjectSettings settings;
  bool is_alive = true;
  bool is_frozen = false;
  Positions seen;                ///< where the last step saw it
  std::optional<PoseRows> pose;  ///< the last that was taken
  bool is_unseen = true;         ///< it or its mesh is new, and no step could read it
  bool jumps = false;            ///< in the next step
  bool is_start_known = false;   ///< the contract says from where the last step swept it
  Positions start;               ///< the last step swept it from there
  std::optional<PoseRows> start_pose;

  // The state that the next step takes up.
  std::optional<Positions> copied;
  std::optional<PoseRows> staged_pose;
  bool is_bound = false;
  BindPolicy policy = BindPolicy::every_step;
  bool is_told = false;
  bool was_told = false;               ///< `positions_changed` was called since the memory was bound
  bool is_promised = false;            ///< bound memory that is written now needs a new promise
  std::unique_ptr<Positions> doubles;  ///< bound memory, one of the two. Freed as soon as the contract allows
  std::unique_ptr<std::vector<Eigen::Vector3f>> floats;

  /// Returns the positions that a read of the bound memory would give.
  [[nodiscard]] Positions memory() const;
  void write_memory(const Positions& positions);
  [[nodiscard]] bool can_take(const Positions& positions) const;
};

/// A promise of how far vertices move: none, one that is kept, or none that makes sense. Or the object jumps.
enum class Promise { none, kept, senseless, jump };

/// The faces of one group of a body.
struct BodyGroup {
  std::size_t body = 0;
  std::uint8_t group = 0;

  friend auto operator<=>(const BodyGroup&, const BodyGroup&) = default;
};

/// Makes calls on a Scene, knows from the contract alone what each must come to, and compares every step with
/// a scene built afresh. Bodies are named by the order in which they were added. Those removed stay, as stale
/// ids.
class SceneModel {
 public:
  explicit SceneModel(const SceneSettings& settings);

  [[nodiscard]] const std::vector<ModelBody>& bodies() const { return bodies_; }

  void add(std::shared_ptr<const Mesh> mesh, ObjectSettings settings);
  void remove(std::size_t body);
  void set_positions(std::size_t body, const Positions& positions, Promise promise);
  void bind(std::size_t body, const Positions& positions, bool as_floats, BindPolicy policy);
  void write(std::size_t body, const Positions& positions, bool tell, Promise promise);
  void unbind(std::size_t body);
  void set_pose(std::size_t body, const PoseRows& rows, bool is_rotation, bool jumps);
  void set_ignored(std::size_t a, std::size_t b, bool ignored);
  void set_ignored_groups(const BodyGroup& a, const BodyGroup& b, bool ignored);
  void replace_mesh(std::size_t body, const std::shared_ptr<const Mesh>& mesh,
                    const std::vector<std::uint32_t>& new_of_old,
                    const std::vector<std::uint8_t>& face_groups);
  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule);
  /// A view that no object takes: of a wrong count, or null.
  void give_bad_view(std::size_t body, bool is_null);

  void step();

 private:
  using BodyPair = std::pair<std::size_t, std::size_t>;
  /// The answer of a scene built afresh about one pair, at any distance.
  struct Fresh {
    ReportHandle report;
    const PairReport* row = nullptr;
    bool in_contact = false;
  };

  void expect_diagnostic(ObjectId id, DiagnosticKind kind) { expected_.emplace(id, kind); }
  /// The body where the call is for a live deformable one. Otherwise the diagnostic is noted.
  ModelBody* deformable(std::size_t body);
  double promise_of(const ModelBody& body, const Positions& positions, Promise promise);
  void read(ModelBody& body);
  void read_bound(ModelBody& body);
  /// Reads a body, and notes from where the step sweeps it.
  void read_and_sweep(ModelBody& body);

  [[nodiscard]] PairRule rule_of(const BodyPair& pair) const;
  /// Below which distance the pair is listed.
  [[nodiscard]] double range_of(const BodyPair& pair) const;
  [[nodiscard]] double threshold_of(const BodyPair& pair) const;
  [[nodiscard]] std::map<BodyPair, Fresh> build_afresh() const;
  /// Whether any body is swept. The scene built afresh then makes two steps, of which the first has
  /// everything where the sweep begins.
  [[nodiscard]] bool sweeps() const;
  /// Whether the contract says from where both objects of a pair were swept.
  [[nodiscard]] bool is_sweep_known(const BodyPair& pair) const;
  /// Asks the patches of the report about where their tools were.
  void check_patches(const ReportHandle& report) const;
  /// Compares queries of the report with the model and with each other.
  void check_queries(const ReportHandle& report) const;
  void check_diagnostics(const FrameReport& report);
  void check_limits(const FrameReport& report) const;
  /// Whether contacts are left to other pairs than in a scene built afresh. Rows of frozen objects and rows
  /// without an answer are not in that one.
  [[nodiscard]] bool has_other_limits(const FrameReport& report) const;
  /// Whether contacts are chosen to carry their pair. The choice goes by the last step too, which a scene
  /// built afresh does not know.
  [[nodiscard]] bool chooses_carrying() const;
  void check_rows(const FrameReport& report, const std::map<BodyPair, Fresh>& fresh);
  void check_row(const FrameReport& report, const PairReport& row, const BodyPair& pair,
                 const Fresh* fresh) const;
  void check_values(const FrameReport& report, const PairReport& row, const BodyPair& pair,
                    const Fresh& fresh) const;
  /// Of a scene that chooses contacts to carry a pair.
  void check_chosen(const FrameReport& report, const PairReport& row, const BodyPair& pair,
                    const Fresh& fresh) const;
  [[nodiscard]] bool is_gone(const BodyPair& pair) const;
  [[nodiscard]] bool is_frozen(const BodyPair& pair) const;
  [[nodiscard]] bool must_be_listed(const BodyPair& pair, const Fresh& fresh) const;

  Scene scene_;
  std::vector<ModelBody> bodies_;
  std::map<ObjectId, std::size_t> body_of_;
  std::multiset<std::pair<ObjectId, DiagnosticKind>> expected_;
  std::set<BodyPair> ignored_;
  std::set<std::pair<BodyGroup, BodyGroup>> ignored_groups_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, PairRule> rules_;
  std::set<BodyPair> in_contact_;  ///< of the last step
  bool is_swept_added_ = false;    ///< since the last step, so that others may have been out of sight before
  std::uint64_t frame_ = 0;
};

}  // namespace graze::fuzz
