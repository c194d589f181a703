#include <algorithm>
#include <graze/enumerators.hpp>
#include <graze/error.hpp>
#include <graze/io/error.hpp>
#include <graze/io/report_json.hpp>

#include "report/report_fields.hpp"
#include "report/report_lines.hpp"
#include "text/json_text.hpp"

namespace graze::io {
namespace {

void write_header(JsonText& json, std::span<const SceneObject> objects, const SceneSettings& settings,
                  const ReportWriter::Options& options) {
  json.open('{').key("graze").whole(1);
  json.key("objects").open('[');
  for (std::size_t id = 0; id < objects.size(); ++id) {
    json.open('{').key("id").whole(id).key("name").text(objects[id].name);
    json.key("vertices")
        .whole(objects[id].mesh->vertex_count())
        .key("faces")
        .whole(objects[id].mesh->face_count());
    json.close('}');
  }
  json.close(']').key("settings");
  write_settings(json, settings);
  if (options.every > 1) json.key("every").whole(options.every);
  if (!options.include_contacts) json.key("contacts").flag(false);
  json.close('}');
}

void write_feature(JsonText& json, const Feature& feature, const Mesh& mesh) {
  json.open('[').text(to_string(feature.kind)).whole(feature.index);
  if (feature.kind == FeatureKind::edge) {
    const auto [low, high] = mesh.edge(feature.index);
    json.open('[').whole(low).whole(high).close(']');
  }
  json.close(']');
}

void write_contact(JsonText& json, const Contact& contact, std::uint64_t since, const Mesh& mesh_a,
                   const Mesh& mesh_b) {
  json.open('{').key("kind").text(to_string(contact.kind)).key("a");
  write_feature(json, contact.feature_a, mesh_a);
  json.key("b");
  write_feature(json, contact.feature_b, mesh_b);
  json.key("distance").real(contact.distance);
  json.key("point_a").point(contact.point_a).key("point_b").point(contact.point_b);
  json.key("normal").point(contact.normal);
  json.key("side").open('[').text(to_string(contact.side_a)).text(to_string(contact.side_b)).close(']');
  if (contact.sunk) json.key("sunk").flag(true);
  json.key("since").whole(since).close('}');
}

void write_witness(JsonText& json, const Witness& witness, const Mesh& mesh_a, const Mesh& mesh_b) {
  json.open('{').key("a");
  write_feature(json, witness.feature_a, mesh_a);
  json.key("b");
  write_feature(json, witness.feature_b, mesh_b);
  json.key("point_a").point(witness.point_a).key("point_b").point(witness.point_b).close('}');
}

void write_way_out(JsonText& json, const WayOut& way) {
  json.key("way_out").open('{').key("direction").point(way.direction).key("point").point(way.point);
  json.key("fullness").real(way.fullness).key("thickness").real(way.thickness);
  json.key("extent").real(way.extent).close('}');
}

void write_impact(JsonText& json, const Impact& impact, const Mesh& mesh_a, const Mesh& mesh_b) {
  json.open('{').key("kind").text(to_string(impact.kind)).key("a");
  write_feature(json, impact.feature_a, mesh_a);
  json.key("b");
  write_feature(json, impact.feature_b, mesh_b);
  json.key("time").open('[').real(impact.lower).real(impact.upper).close(']');
  json.key("status").text(name_of(impact.status)).close('}');
}

/// Writes what met on the way, where something did.
void write_sweep(JsonText& json, const PairReport& pair, std::span<const Impact> impacts, const Mesh& mesh_a,
                 const Mesh& mesh_b) {
  if (pair.time_of_impact < 1) json.key("time_of_impact").real(pair.time_of_impact);
  if (pair.time_of_gap < 1) json.key("time_of_gap").real(pair.time_of_gap);
  if (impacts.empty()) return;
  json.key("impacts").open('[');
  for (const Impact& impact : impacts) write_impact(json, impact, mesh_a, mesh_b);
  json.close(']');
}

ReportWriter::Options checked_options(const ReportWriter::Options& options) {
  if (options.every == 0) throw Error("report: each 0th frame was asked for; give 1 or more as every");
  return options;
}

}  // namespace

struct ReportWriter::State {
  State(const std::filesystem::path& file, const Options& writer_options)
      : path(file.string()), lines(file), options(writer_options) {}

  void write_line();
  void write_pair(std::uint64_t frame, const FrameReport& report, const PairReport& pair);
  /// The number of `id` among the objects, or their count for an id that is not one of them.
  [[nodiscard]] std::size_t number_of(ObjectId id) const;

  std::string path;
  ReportLinesOut lines;
  std::vector<SceneObject> objects;
  std::vector<std::pair<ObjectId, std::size_t>> numbers;  ///< ascending by id
  Options options;
  std::uint64_t calls = 0;  ///< of ReportWriter::write()
  JsonText json;
};

std::size_t ReportWriter::State::number_of(ObjectId id) const {
  const auto found = std::ranges::lower_bound(numbers, id, {}, &std::pair<ObjectId, std::size_t>::first);
  return found != numbers.end() && found->first == id ? found->second : objects.size();
}

void ReportWriter::State::write_pair(std::uint64_t frame, const FrameReport& report, const PairReport& pair) {
  const std::size_t a = number_of(pair.a);
  const std::size_t b = number_of(pair.b);
  if (a == objects.size() || b == objects.size())
    throw InputError(path +
                     ": the report has an object that the header has not; add objects before the writer");
  const Mesh& mesh_a = *objects[a].mesh;
  const Mesh& mesh_b = *objects[b].mesh;
  json.open('{').key("a").whole(a).key("b").whole(b).key("phase").text(to_string(pair.phase));
  if (!pair.complete) json.key("complete").flag(false);
  if (pair.contacts_cut) json.key("contacts_cut").flag(true);
  if (pair.stale) json.key("stale").flag(true);
  if (pair.inside != Inside::none) json.key("inside").text(to_string(pair.inside));
  json.key("distance").open('[').real(pair.distance.lower).real(pair.distance.upper).close(']');
  json.key("witness");
  write_witness(json, pair.witness, mesh_a, mesh_b);
  if (is_written(pair.way_out)) write_way_out(json, pair.way_out);
  write_sweep(json, pair, report.impacts(pair), mesh_a, mesh_b);
  if (options.include_contacts) {
    json.key("contacts").open('[');
    for (const Contact& contact : report.contacts(pair))
      write_contact(json, contact, since_in_file(contact.since, frame, report), mesh_a, mesh_b);
    json.close(']');
  } else {
    json.key("contact_count").whole(report.contacts(pair).size());
  }
  json.close('}');
}

void ReportWriter::State::write_line() {
  lines.write(json.line());
  json.clear();
}

ReportWriter::ReportWriter(const std::filesystem::path& path, std::span<const SceneObject> objects,
                           const SceneSettings& settings, Options options)
    : state_(std::make_unique<State>(path, checked_options(options))) {
  state_->objects.assign(objects.begin(), objects.end());
  for (std::size_t number = 0; number < objects.size(); ++number)
    state_->numbers.emplace_back(objects[number].id, number);
  std::ranges::sort(state_->numbers);
  write_header(state_->json, objects, settings, options);
  state_->write_line();
}

ReportWriter::~ReportWriter() = default;
ReportWriter::ReportWriter(ReportWriter&&) noexcept = default;
ReportWriter& ReportWriter::operator=(ReportWriter&&) noexcept = default;

void ReportWriter::write(std::uint64_t frame, const FrameReport& report) {
  if (state_->calls++ % state_->options.every != 0) return;
  JsonText& json = state_->json;
  json.open('{').key("frame").whole(frame).key("complete").flag(report.complete());
  json.key("pairs").open('[');
  for (const PairReport& pair : report.pairs()) state_->write_pair(frame, report, pair);
  json.close(']').key("diagnostics").open('[');
  for (const Diagnostic& diagnostic : report.diagnostics()) {
    const std::size_t number = state_->number_of(diagnostic.object);
    json.open('{').key("object");
    if (number == state_->objects.size())
      json.null();
    else
      json.whole(number);
    json.key("kind").text(to_string(diagnostic.kind)).key("message").text(diagnostic.message).close('}');
  }
  json.close(']').key("statistics");
  write_statistics(json, report.statistics(), state_->options.include_times);
  json.close('}');
  state_->write_line();
}

void ReportWriter::close() {
  state_->lines.close();
}

}  // namespace graze::io
