#include "fuzz/recording/made_recording.hpp"

#include <array>
#include <deque>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "fuzz/byte_reader.hpp"
#include "fuzz/recording/recording_builder.hpp"

namespace graze::fuzz {
namespace {

constexpr std::uint32_t mesh_count = 4;

/// A quad, a triangle, a tetrahedron, and a quad with a vertex that no face uses.
std::vector<std::shared_ptr<const Mesh>> made_meshes() {
  using Points = std::vector<Eigen::Vector3d>;
  using Counts = std::vector<std::uint32_t>;
  const Points square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  Points with_unused = square;
  with_unused.emplace_back(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  const auto make = [](const Points& points, const Counts& corners, const Counts& counts) {
    return std::make_shared<const Mesh>(Mesh::from_polygons(points, corners, counts));
  };
  return {
      make(square, {0, 1, 2, 3}, {4}), make({{0, 0, 0.25}, {1, 0, 1}, {0, 1, 1}}, {0, 1, 2}, {3}),
      make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}, {3, 3, 3, 3}),
      make(with_unused, {0, 1, 2, 3}, {4})};
}

SceneSettings made_settings(ByteReader& bytes) {
  SceneSettings settings;
  settings.threads = 1;
  settings.contact_distance = bytes.below(8) / 16.0;
  settings.range = bytes.below(8) / 4.0;
  settings.detail = static_cast<ContactDetail>(bytes.below(underlying(ContactDetail::nearest) + 1U));
  if (bytes.once_in(4)) settings.accuracy = Accuracy::within(bytes.below(8) / 8.0);
  if (bytes.once_in(4)) settings.max_contacts = 1 + bytes.below(8);
  if (bytes.once_in(4)) settings.work_budget = bytes.below(32);
  if (bytes.once_in(4)) settings.region_distances = bytes.below(32);
  settings.ways_out = bytes.flag();
  if (bytes.once_in(4)) settings.carrying = 1 + bytes.below(4);
  if (bytes.once_in(8)) settings.carrying_band = bytes.below(8) / 16.0;
  return settings;
}

/// Makes records. It knows the objects that its own records have made, so that most records fit.
class RecordMaker {
 public:
  explicit RecordMaker(ByteReader& bytes) : bytes_(bytes), meshes_(made_meshes()) {}

  [[nodiscard]] const std::vector<std::shared_ptr<const Mesh>>& meshes() const { return meshes_; }
  /// A record of any kind, or one that adds an object while there are few.
  Record make() {
    if (known_.size() < 2) return make_of<AddRecord>();
    return make_of_kind(bytes_.below(std::variant_size_v<Record>),
                        std::make_index_sequence<std::variant_size_v<Record>>());
  }
  /// Records that add the objects that are there.
  [[nodiscard]] std::vector<Record> additions() const {
    std::vector<Record> records;
    for (const Known& known : known_) {
      AddRecord record{known.id, known.serial, known.mesh, {}};
      record.settings.motion = known.motion;
      records.emplace_back(record);
    }
    return records;
  }
  /// A row of any two objects, with an answer that is made up.
  RecordedRow make_row() {
    RecordedRow row;
    row.a = object().id;
    row.b = object().id;
    row.phase = static_cast<PairPhase>(bytes_.below(4));
    row.complete = !bytes_.once_in(4);
    row.upper = bytes_.below(8);
    row.contacts = bytes_.below(4);
    return row;
  }
  void forget() { known_.clear(); }

 private:
  struct Known {
    ObjectId id;
    std::uint64_t serial = 0;
    std::uint32_t mesh = 0;
    Motion motion = Motion::deformable;
    bool is_bound = false;
    bool is_double = true;       ///< the form of its binding
    bool is_memory_bad = false;  ///< so that it is frozen
  };

  template <typename OneRecord>
  OneRecord make_of() {
    OneRecord record{};
    fill(record);
    return record;
  }
  template <std::size_t... kinds>
  Record make_of_kind(std::size_t kind, std::index_sequence<kinds...>) {
    Record record;
    (void)((kind == kinds && (record = make_of<std::variant_alternative_t<kinds, Record>>(), true)) || ...);
    return record;
  }

  /// Whether the next thing is to be one that does not fit.
  bool wrong() { return bytes_.once_in(128); }
  /// One of the objects that are there, or now and then none.
  Known object() {
    if (known_.empty() || bytes_.once_in(24)) return {{bytes_.below(8), bytes_.below(3)}, 0, 0};
    return known_[bytes_.below(static_cast<std::uint32_t>(known_.size()))];
  }
  /// One that moves by positions, or by poses. None if no object does so.
  Known object_of(bool is_deformable) {
    if (wrong()) return object();
    std::vector<Known> fitting;
    for (const Known& known : known_)
      if ((known.motion == Motion::deformable) == is_deformable) fitting.push_back(known);
    if (fitting.empty()) return {};
    return fitting[bytes_.below(static_cast<std::uint32_t>(fitting.size()))];
  }
  void set_binding(ObjectId id, bool is_bound, bool is_double) {
    for (Known& known : known_)
      if (known.id == id) {
        known.is_bound = is_bound;
        known.is_double = is_double;
        known.is_memory_bad = false;
      }
  }
  double coordinate() { return bytes_.below(64) / 32.0; }
  /// Positions, mostly one for each vertex. The first may be none that a scene takes.
  PositionView positions(std::uint32_t mesh, bool is_double, bool may_be_bad) {
    std::size_t count = meshes_[mesh % mesh_count]->vertex_count();
    if (wrong()) count = bytes_.below(8);
    std::vector<double>& doubles = doubles_.emplace_back();
    for (std::size_t i = 0; i < 3 * count; ++i) doubles.push_back(coordinate());
    if (may_be_bad && count > 0) doubles[0] = bytes_.flag() ? 1e38 : std::numeric_limits<double>::quiet_NaN();
    if (is_double) return PositionView(doubles.data(), count);
    std::vector<float>& floats = floats_.emplace_back();
    for (const double number : doubles) floats.push_back(static_cast<float>(number));
    return PositionView(floats.data(), count);
  }
  PositionView positions(const Known& known, bool may_be_bad) {
    return positions(known.mesh, wrong() != known.is_double, may_be_bad);
  }
  std::vector<std::uint8_t> groups(std::uint32_t mesh) {
    if (!bytes_.once_in(3)) return {};
    std::vector<std::uint8_t> all(meshes_[mesh % mesh_count]->face_count() + (wrong() ? 1U : 0U));
    for (std::uint8_t& group : all) group = static_cast<std::uint8_t>(bytes_.below(2));
    return all;
  }
  std::uint32_t mesh() { return wrong() ? 99 : bytes_.below(mesh_count); }
  double promise() { return wrong() ? -1.0 : bytes_.flag() ? bytes_.below(4) / 4.0 : 1e30; }
  std::array<double, 12> pose() {
    std::array<double, 12> rows{1, 0, 0, coordinate(), 0, 1, 0, coordinate(), 0, 0, 1, 0};
    if (wrong()) rows[0] = 2;
    return rows;
  }
  DiagnosticKind any_kind() {
    return static_cast<DiagnosticKind>(bytes_.below(underlying(DiagnosticKind::out_of_memory) + 1U));
  }

  // One for each kind of record. A new kind does not compile until it is here.
  void fill(AddRecord& record);
  void fill(RemoveObject& record);
  void fill(SetPose& record) {
    record.object = object_of(false).id;
    record.rows = pose();
  }
  void fill(RefusePose& record) {
    const auto kind = wrong() ? any_kind() : DiagnosticKind::bad_pose;
    record.problem = {object_of(false).id, kind, std::string(made_message)};
  }
  void fill(PositionsRecord& record) {
    const Known known = object_of(true);
    record.object = known.id;
    record.max_displacement = promise();
    set_binding(known.id, false, true);
    record.positions = positions(known.mesh, bytes_.flag(), wrong());
  }
  void fill(BindRecord& record) {
    record.object = object_of(true).id;
    record.policy = bytes_.flag() ? BindPolicy::when_told : BindPolicy::every_step;
    record.is_double = bytes_.flag();
    set_binding(record.object, true, record.is_double);
  }
  void fill(MemoryRecord& record) {
    const Known known = object_of(true);
    record.object = known.is_bound || wrong() ? known.id : ObjectId();
    const bool is_bad = bytes_.once_in(4);
    record.positions = positions(known, is_bad);
    for (Known& one : known_)
      if (one.id == record.object) one.is_memory_bad = is_bad;
  }
  void fill(UnbindRecord& record) {
    const Known known = object_of(true);
    record.object = known.id;
    record.is_lost = bytes_.once_in(8);
    // Who was frozen by bad memory stays so. A recorder never says otherwise.
    record.is_frozen = known.is_memory_bad || bytes_.once_in(4);
    if (bytes_.once_in(4)) record.problem = DiagnosticKind::not_finite;
    if (wrong()) record.problem = any_kind();
    if (bytes_.flag()) record.positions = positions(known, wrong());
    set_binding(known.id, false, true);
  }
  void fill(PositionsChanged& record) {
    record.object = object_of(true).id;
    record.max_displacement = promise();
  }
  void fill(SettlePose& record) { record.object = object_of(false).id; }
  void fill(MarkTeleport& record) { record.object = object().id; }
  void fill(IgnorePair& record) {
    record.a = object().id;
    record.b = object().id;
    if (record.a == record.b && !wrong()) record.b = ObjectId{99, 1};
    record.ignored = bytes_.flag();
  }
  void fill(SetRule& record) {
    record.kind_a = wrong() ? 256 : bytes_.below(3);
    record.kind_b = bytes_.below(3);
    if (bytes_.flag()) record.rule.contact_distance = bytes_.below(4) / 8.0;
    if (bytes_.flag()) record.rule.range = wrong() ? -1.0 : bytes_.below(4) / 2.0;
  }
  void fill(Reserve& record) { record.capacity.objects = bytes_.raw<std::size_t>(); }
  void fill(Diagnostic& record) { record = {object().id, any_kind(), std::string(made_message)}; }
  void fill(IgnoreGroups& record) {
    record.a = object().id;
    record.b = object().id;
    record.group_a = bytes_.byte();
    record.group_b = static_cast<std::uint8_t>(bytes_.below(2));
    record.ignored = bytes_.flag();
  }
  void fill(ReplaceRecord& record);

  ByteReader& bytes_;
  std::vector<std::shared_ptr<const Mesh>> meshes_;
  std::vector<Known> known_;
  std::uint32_t next_index_ = 0;
  std::uint64_t next_serial_ = 0;
  std::deque<std::vector<double>> doubles_;  ///< what positions view
  std::deque<std::vector<float>> floats_;
};

void RecordMaker::fill(AddRecord& record) {
  record.object = wrong() ? object().id : ObjectId{next_index_++, 1};
  record.serial = wrong() ? bytes_.below(4) : next_serial_++;
  record.mesh = mesh();
  record.settings.motion = bytes_.once_in(3) ? static_cast<Motion>(bytes_.below(3)) : Motion::deformable;
  record.settings.margin = wrong() ? -1.0 : bytes_.below(4) / 16.0;
  record.settings.kind = bytes_.below(3);
  record.settings.solid = record.mesh == 2 ? bytes_.flag() : wrong();
  record.settings.face_groups = groups(record.mesh);
  record.settings.queries = bytes_.flag();
  if (bytes_.once_in(4)) record.settings.patch_radius = wrong() ? -1.0 : bytes_.below(4) / 4.0;
  if (wrong()) record.settings.patch_faces = 0;
  if (bytes_.once_in(4)) record.settings.hidden_groups = {static_cast<std::uint8_t>(bytes_.below(3))};
  known_.push_back({record.object, record.serial, record.mesh, record.settings.motion});
}

void RecordMaker::fill(RemoveObject& record) {
  record.object = object().id;
  if (bytes_.once_in(8)) return;  // later records still speak of it
  std::erase_if(known_, [&](const Known& known) { return known.id == record.object; });
}

void RecordMaker::fill(ReplaceRecord& record) {
  const Known known = object();
  record.object = known.id;
  record.mesh = mesh();
  std::size_t count = meshes_[known.mesh % mesh_count]->vertex_count();
  if (wrong()) ++count;
  const std::uint32_t new_count = meshes_[record.mesh % mesh_count]->vertex_count();
  for (std::size_t i = 0; i < count; ++i)
    record.new_of_old.push_back(bytes_.once_in(4) ? Mesh::no_vertex
                                                  : bytes_.below(new_count) + (wrong() ? 8U : 0U));
  record.face_groups = groups(record.mesh);
  for (Known& one : known_)
    if (one.id == known.id) one.mesh = record.mesh;
  set_binding(known.id, false, true);
}

}  // namespace

void make_recording(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  ByteReader reader(bytes);
  RecordingBuilder builder(path, made_settings(reader));
  RecordMaker maker(reader);
  for (const auto& mesh : maker.meshes()) builder.add_mesh(*mesh);
  constexpr std::size_t most_steps = 8;
  for (std::size_t step = 0; step < most_steps && (step == 0 || !reader.at_end()); ++step) {
    const bool is_fresh = step == 0 || reader.once_in(16);
    if (step == 0) builder.add_keyframe({});
    if (step > 0 && reader.once_in(4)) builder.add_keyframe(maker.additions());
    if (is_fresh) maker.forget();
    std::vector<Record> records;
    for (std::uint32_t count = 1 + reader.below(8); count > 0; --count) records.push_back(maker.make());
    std::vector<RecordedRow> rows;
    for (std::uint32_t count = reader.below(3); count > 0; --count) rows.push_back(maker.make_row());
    builder.add_step(records, rows, is_fresh);
  }
  builder.finish();
}

}  // namespace graze::fuzz
