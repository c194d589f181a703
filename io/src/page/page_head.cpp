#include "page/page_head.hpp"

#include <algorithm>
#include <concepts>
#include <graze/scene_enumerators.hpp>
#include <graze/settings_fields.hpp>
#include <optional>
#include <span>

#include "report/report_fields.hpp"
#include "report/statistics_fields.hpp"
#include "text/file_bytes.hpp"
#include "text/json_text.hpp"

namespace graze::io {
namespace {

/// Version 2 says which contacts are sunk.
constexpr std::uint64_t page_version = 2;

void write_whole_numbers(JsonText& json, std::string_view key, const std::vector<std::uint64_t>& numbers) {
  json.key(key).open('[');
  for (const std::uint64_t number : numbers) json.whole(number);
  json.close(']');
}

void write_dropped(JsonText& json, const std::vector<DroppedFrames>& dropped) {
  json.key("dropped").open('[');
  for (const auto& [before, count] : dropped) json.open('[').whole(before).whole(count).close(']');
  json.close(']');
}

/// Frames of objects that never appear may be -1.
void write_page_frame(JsonText& json, std::string_view key, std::int64_t frame) {
  json.key(key);
  if (frame < 0)
    json.real(static_cast<double>(frame));
  else
    json.whole(static_cast<std::uint64_t>(frame));
}

void put_setting(JsonText& json, bool value) {
  json.flag(value);
}
void put_setting(JsonText& json, double value) {
  json.real(value);
}
void put_setting(JsonText& json, std::unsigned_integral auto value) {
  json.whole(value);
}
void put_setting(JsonText& json, const std::vector<std::uint8_t>& groups) {
  json.open('[');
  for (const std::uint8_t group : groups) json.whole(group);
  json.close(']');
}

/// The settings that have no key of their own, and are not as usual. Those for answers between steps are left
/// out, since a page asks none.
void write_further_settings(JsonText& json, const ObjectSettings& settings) {
  const ObjectSettings usual;
  bool has_any = false;
  for_each_field<ObjectSettings, &ObjectSettings::name, &ObjectSettings::motion, &ObjectSettings::user_data,
                 &ObjectSettings::solid, &ObjectSettings::swept, &ObjectSettings::queries,
                 &ObjectSettings::patch_radius, &ObjectSettings::patch_faces>([&](const auto& field) {
    if (settings.*field.member == usual.*field.member) return;
    if (!has_any) json.key("settings").open('{');
    has_any = true;
    put_setting(json.key(field.name), settings.*field.member);
  });
  if (has_any) json.close('}');
}

void write_head_object(JsonText& json, const PageHeadObject& object, std::size_t serial) {
  json.open('{').key("serial").whole(serial).key("name").text(object.name);
  json.key("motion").text(name_of(object.motion)).key("solid").flag(object.solid);
  json.key("swept").flag(object.swept).key("mesh").whole(object.mesh);
  write_further_settings(json, object.settings);
  write_page_frame(json, "first", object.first);
  write_page_frame(json, "last", object.last);
  json.key("user_data").text(std::to_string(object.user_data));
  json.key("position_error").real(object.position_error).close('}');
}

void write_head_mesh(JsonText& json, const MeshCounts& mesh, std::size_t number) {
  json.open('{').key("chunk").text(numbered_chunk("mesh", number));
  json.key("vertices").whole(mesh.vertices).key("edges").whole(mesh.edges);
  json.key("triangles").whole(mesh.triangles).key("quads").whole(mesh.quads);
  json.key("levels").whole(mesh.levels).close('}');
}

std::optional<double> deepest_separation(std::span<const Contact> contacts) {
  if (contacts.empty()) return std::nullopt;
  return std::ranges::min_element(contacts, {}, &Contact::separation)->separation();
}

}  // namespace

void PageSeries::add(const FrameReport& report, bool include_times) {
  std::array<std::uint64_t, 7> rows{};
  for (const PairReport& pair : report.pairs()) {
    rows[0] += pair.phase == PairPhase::began ? 1 : 0;
    rows[1] += pair.phase == PairPhase::ended ? 1 : 0;
    rows[2] += pair.complete ? 0 : 1;
    rows[3] += pair.stale ? 1 : 0;
    rows[4] += pair.contacts_cut ? 1 : 0;
    rows[5] += pair.inside == Inside::a_in_b || pair.inside == Inside::b_in_a ? 1 : 0;
    rows[6] += pair.inside == Inside::crossing ? 1 : 0;
  }
  const StepStatistics& statistics = report.statistics();
  const std::array<std::uint64_t, count_names.size()> values{statistics.contacts,
                                                             statistics.pairs_near,
                                                             statistics.pairs_in_contact,
                                                             rows[0],
                                                             rows[1],
                                                             rows[2],
                                                             rows[3],
                                                             rows[4],
                                                             rows[5],
                                                             rows[6],
                                                             report.diagnostics().size(),
                                                             report.impacts().size()};
  for (std::size_t i = 0; i < values.size(); ++i) counts_[i].push_back(values[i]);
  for (std::size_t i = 0; i < time_fields.size(); ++i)
    times_[i].push_back(include_times ? statistics.times.*time_fields[i].member : 0);
  deepest_.push_back(deepest_separation(report.contacts()));
}

bool PageSeries::has_impacts() const {
  static_assert(count_names.back() == "impacts");
  return std::ranges::any_of(counts_.back(), [](std::uint64_t count) { return count > 0; });
}

void PageSeries::write(JsonText& json) const {
  json.open('{');
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (count_names[i] != "impacts" || has_impacts()) write_whole_numbers(json, count_names[i], counts_[i]);
  for (std::size_t i = 0; i < times_.size(); ++i) {
    json.key(time_fields[i].name).open('[');
    for (const double time : times_[i]) json.real(time);
    json.close(']');
  }
  json.key("deepest").open('[');
  for (const std::optional<double>& separation : deepest_) separation ? json.real(*separation) : json.null();
  json.close(']');
  json.close('}');
}

std::string PageHead::json() const {
  JsonText json;
  json.open('{').key("version").whole(page_version).key("graze").text(GRAZE_VERSION);
  json.key("title").text(options.title).key("source").text(options.source).key("settings");
  write_settings(json, options.settings);
  json.key("frames").whole(frame_numbers.size());
  write_whole_numbers(json, "frame_numbers", frame_numbers);
  json.key("every").whole(options.every).key("source_frames").whole(source_frames);
  json.key("block").whole(block).key("objects").open('[');
  for (std::size_t i = 0; i < objects.size(); ++i) write_head_object(json, objects[i], i);
  json.close(']').key("meshes").open('[');
  for (std::size_t i = 0; i < meshes.size(); ++i) write_head_mesh(json, meshes[i], i);
  json.close(']').key("series");
  series.write(json);
  if (!diverged.empty()) write_whole_numbers(json, "diverged", diverged);
  if (!dropped.empty()) write_dropped(json, dropped);
  filters.write(json, options.every, frame_numbers.size());
  json.close('}');
  return json.line();
}

std::string numbered_chunk(std::string_view kind, std::uint64_t number) {
  return joined(kind, "/", number);
}

}  // namespace graze::io
