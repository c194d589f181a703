// The input is a report. What reads is written again, with meshes of the sizes that its header says, and must
// read back the same.

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <graze/io/report_json.hpp>
#include <optional>

#include "byte_reader.hpp"
#include "finding.hpp"
#include "fuzz/scenes/report_meshes.hpp"
#include "input_folder.hpp"
#include "report/report_builder.hpp"
#include "report/report_fields.hpp"
#include "report/statistics_fields.hpp"

namespace graze::fuzz {
namespace {

struct Report {
  std::vector<io::ReportedObject> objects;
  SceneSettings settings;
  std::vector<io::ReportedFrame> frames;
};

/// Nothing where the file is refused, whole or from some line on.
std::optional<Report> read_report(const std::filesystem::path& path) {
  std::optional<Report> report(std::in_place);
  const bool taken = accepts([&] {
    io::ReportReader reader(path);
    report->objects.assign(reader.objects().begin(), reader.objects().end());
    report->settings = reader.settings();
    while (auto frame = reader.next()) report->frames.push_back(std::move(*frame));
  });
  return taken ? std::move(report) : std::nullopt;
}

/// Whether the writer could have written it: features that the meshes have, objects that the header has.
bool is_writable(const Report& report, const std::vector<io::SceneObject>& objects) {
  const auto has = [&](std::uint32_t object, const Feature& feature, const io::EdgeVertices& edge) {
    const Mesh& mesh = *objects[object].mesh;
    if (feature.kind == FeatureKind::vertex) return feature.index < mesh.vertex_count();
    if (feature.kind == FeatureKind::face) return feature.index < mesh.face_count();
    return feature.index < mesh.edge_count() && mesh.edge(feature.index) == edge;
  };
  for (const io::ReportedFrame& frame : report.frames) {
    bool complete = true;
    for (const io::ReportedPair& pair : frame.pairs) {
      complete = complete && pair.complete;
      if (pair.a >= objects.size() || pair.b >= objects.size()) return false;
      if (!has(pair.a, pair.witness.feature_a, pair.witness_edge_a) ||
          !has(pair.b, pair.witness.feature_b, pair.witness_edge_b))
        return false;
      for (const io::ReportedContact& c : pair.contacts)
        if (!has(pair.a, c.contact.feature_a, c.edge_a) || !has(pair.b, c.contact.feature_b, c.edge_b))
          return false;
    }
    if (complete != frame.complete) return false;
  }
  return true;
}

FrameReport report_of(const io::ReportedFrame& frame, const std::vector<io::SceneObject>& objects) {
  FrameReport report;
  ReportBuilder builder(report);
  builder.begin(frame.frame, 0);
  std::vector<Contact> contacts;
  for (const io::ReportedPair& read : frame.pairs) {
    PairReport pair;
    pair.a = objects[read.a].id;
    pair.b = objects[read.b].id;
    pair.phase = read.phase;
    pair.complete = read.complete;
    pair.contacts_cut = read.contacts_cut;
    pair.stale = read.stale;
    pair.inside = read.inside;
    pair.distance = read.distance;
    pair.witness = read.witness;
    pair.way_out = read.way_out;
    for (const io::ReportedContact& contact : read.contacts) contacts.push_back(contact.contact);
    builder.add(pair, read.contacts.size(), {});
  }
  std::copy(contacts.begin(), contacts.end(), builder.contacts().begin());
  for (const io::ReportedDiagnostic& read : frame.diagnostics) {
    const bool is_named = read.object && *read.object < objects.size();
    builder.diagnostics().push_back(
        {is_named ? objects[*read.object].id : ObjectId{}, read.kind, read.message});
  }
  builder.statistics() = frame.statistics;
  return report;
}

/// Everything that was read, every double by its bits, but for an object's id, for NaN, which has one
/// spelling, and for a way out that no report has.
class Written {
 public:
  explicit Written(const Report& report) {
    for (const io::ReportedObject& object : report.objects) add(object.name, object.vertices, object.faces);
    io::for_each_reported_setting([&](const auto& field) { add(report.settings.*field.member); });
    for (const io::ReportedFrame& frame : report.frames) add(frame, report.objects.size());
  }
  friend bool operator==(const Written&, const Written&) = default;

 private:
  void add(const std::string& text) { text_ += text + "\n"; }
  void add(double number) {
    text_ += (std::isnan(number) ? "nan" : std::to_string(std::bit_cast<std::uint64_t>(number))) + "\n";
  }
  template <std::integral Number>
  void add(Number number) {
    text_ += std::to_string(number) + "\n";
  }
  template <typename Enumerator>
  requires std::is_enum_v<Enumerator>
  void add(Enumerator enumerator) { add(static_cast<int>(enumerator)); }
  void add(const Eigen::Vector3d& point) { add(point.x(), point.y(), point.z()); }
  void add(const Accuracy& accuracy) {
    add(accuracy.mode(), accuracy.tolerance());
    for (const double epsilon : accuracy.epsilon()) add(epsilon);
  }
  void add(std::chrono::microseconds time) { add(time.count()); }
  template <typename Value>
  void add(const std::optional<Value>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  void add(const Feature& feature) { add(feature.kind, feature.index); }
  void add(const WayOut& way) {
    if (io::is_written(way)) add(way.direction, way.point, way.fullness, way.thickness, way.extent);
  }
  template <typename First, typename... More>
  requires(sizeof...(More) > 0) void add(const First& first, const More&... more) {
    add(first);
    (add(more), ...);
  }

  void add(const io::ReportedFrame& frame, std::size_t object_count) {
    add(frame.frame, frame.complete);
    for (const io::ReportedPair& pair : frame.pairs) {
      add(pair.a, pair.b, pair.phase, pair.complete, pair.contacts_cut, pair.stale, pair.inside);
      add(pair.distance.lower, pair.distance.upper);
      add(pair.witness.feature_a, pair.witness.feature_b, pair.witness.point_a, pair.witness.point_b);
      add(pair.way_out);
      for (const io::ReportedContact& read : pair.contacts) {
        const Contact& contact = read.contact;
        add(contact.kind, contact.feature_a, contact.feature_b, contact.distance, contact.side_a,
            contact.side_b, contact.sunk);
        add(contact.point_a, contact.point_b, contact.normal, contact.since);
      }
    }
    for (const io::ReportedDiagnostic& diagnostic : frame.diagnostics) {
      const bool is_named = diagnostic.object && *diagnostic.object < object_count;
      add(is_named ? std::to_string(*diagnostic.object) : std::string("none"));
      add(diagnostic.kind, diagnostic.message);
    }
    const StepStatistics& statistics = frame.statistics;
    for (const auto& [name, member] : io::count_fields) add(statistics.*member);
    for (const auto& [name, member] : io::work_fields) add(statistics.work.*member);
    for (const auto& [name, member] : io::bytes_fields) add(statistics.bytes.*member);
    for (const std::uint64_t count : statistics.work.regions_expanded) add(count);
    for (const auto& [name, member] : io::time_fields) add(statistics.times.*member);
  }

  std::string text_;
};

void write_report(const Report& report, const std::vector<io::SceneObject>& objects,
                  const std::filesystem::path& path) {
  io::ReportWriter writer(path, objects, report.settings);
  for (const io::ReportedFrame& frame : report.frames) writer.write(frame.frame, report_of(frame, objects));
  writer.close();
}

void run(std::span<const std::uint8_t> bytes) {
  const std::optional<Report> report = read_report(write_input("report.jsonl", bytes));
  if (!report) return;
  std::vector<io::SceneObject> objects;
  for (const io::ReportedObject& read : report->objects) {
    if (!has_report_mesh(read.vertices, read.faces)) return;
    const auto index = static_cast<std::uint32_t>(objects.size());
    objects.push_back({{index, 1}, read.name, report_mesh(read.vertices, read.faces)});
  }
  if (!is_writable(*report, objects)) return;
  const auto path = input_folder() / "again.jsonl";
  write_report(*report, objects, path);
  const std::optional<Report> again = read_report(path);
  expect(again.has_value(), "what was written is refused");
  expect(Written(*again) == Written(*report), "what was written reads back as another report");
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run({data, size});
  return 0;
}
