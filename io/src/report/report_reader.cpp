#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <graze/error.hpp>
#include <graze/io/error.hpp>
#include <graze/io/report_json.hpp>
#include <graze/scene_enumerators.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "report/report_fields.hpp"
#include "report/report_lines.hpp"
#include "report/statistics_fields.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

/// An error in one line. The reader adds the file and the line number.
class BadLine : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The enumerator whose name a JSON text is.
template <NamedEnumeration Enum>
Enum named(const json& value) {
  const auto& word = value.get_ref<const std::string&>();
  const auto found = enumerator_named<Enum>(word);
  if (!found) throw BadLine("\"" + word + "\" is no word of the format");
  return *found;
}

/// A whole number that `Whole` holds. The parser's own conversion takes any number, rounded or wrapped
/// around.
template <typename Whole>
Whole read_whole(const json& value) {
  const bool fits = value.is_number_integer() &&
                    (value.is_number_unsigned() ? std::in_range<Whole>(value.get<std::uint64_t>())
                                                : std::in_range<Whole>(value.get<std::int64_t>()));
  if (!fits) throw BadLine("a number is not whole, or too large or small for its place");
  return value.get<Whole>();
}

double read_real(const json& value) {
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (value == "infinity") return std::numeric_limits<double>::infinity();
  if (value == "-infinity") return -std::numeric_limits<double>::infinity();
  return value.get<double>();
}

Eigen::Vector3d read_point(const json& value) {
  return {read_real(value.at(0)), read_real(value.at(1)), read_real(value.at(2))};
}

EdgeVertices read_edge(const json& value) {
  return {read_whole<std::uint32_t>(value.at(0)), read_whole<std::uint32_t>(value.at(1))};
}

Feature read_feature(const json& value, EdgeVertices& edge) {
  const Feature feature{named<FeatureKind>(value.at(0)), read_whole<std::uint32_t>(value.at(1))};
  if (feature.kind == FeatureKind::edge) edge = read_edge(value.at(2));
  return feature;
}

/// Reads a contact. Its `since` stays in the numbers of the file, as ReportedFrame::frame does.
ReportedContact read_contact(const json& value) {
  ReportedContact read;
  read.contact.kind = named<ContactKind>(value.at("kind"));
  read.contact.feature_a = read_feature(value.at("a"), read.edge_a);
  read.contact.feature_b = read_feature(value.at("b"), read.edge_b);
  read.contact.distance = read_real(value.at("distance"));
  read.contact.point_a = read_point(value.at("point_a"));
  read.contact.point_b = read_point(value.at("point_b"));
  read.contact.normal = read_point(value.at("normal"));
  read.contact.side_a = named<Side>(value.at("side").at(0));
  read.contact.side_b = named<Side>(value.at("side").at(1));
  read.contact.sunk = value.value("sunk", false);
  if (value.contains("since")) read.contact.since = read_whole<std::uint64_t>(value.at("since"));
  return read;
}

WayOut read_way_out(const json& value) {
  return {read_point(value.at("direction")), read_point(value.at("point")), read_real(value.at("fullness")),
          read_real(value.at("thickness")), read_real(value.at("extent"))};
}

ReportedImpact read_impact(const json& value) {
  ReportedImpact read;
  read.impact.kind = named<ContactKind>(value.at("kind"));
  read.impact.feature_a = read_feature(value.at("a"), read.edge_a);
  read.impact.feature_b = read_feature(value.at("b"), read.edge_b);
  read.impact.lower = read_real(value.at("time").at(0));
  read.impact.upper = read_real(value.at("time").at(1));
  read.impact.status = named<ImpactStatus>(value.at("status"));
  return read;
}

ReportedPair read_pair(const json& value) {
  ReportedPair pair;
  pair.a = read_whole<std::uint32_t>(value.at("a"));
  pair.b = read_whole<std::uint32_t>(value.at("b"));
  pair.phase = named<PairPhase>(value.at("phase"));
  pair.complete = value.value("complete", true);
  pair.contacts_cut = value.value("contacts_cut", false);
  pair.stale = value.value("stale", false);
  if (value.contains("inside")) pair.inside = named<Inside>(value.at("inside"));
  pair.distance = {read_real(value.at("distance").at(0)), read_real(value.at("distance").at(1))};
  const json& witness = value.at("witness");
  pair.witness.feature_a = read_feature(witness.at("a"), pair.witness_edge_a);
  pair.witness.feature_b = read_feature(witness.at("b"), pair.witness_edge_b);
  pair.witness.point_a = read_point(witness.at("point_a"));
  pair.witness.point_b = read_point(witness.at("point_b"));
  if (value.contains("way_out")) pair.way_out = read_way_out(value.at("way_out"));
  if (value.contains("time_of_impact")) pair.time_of_impact = read_real(value.at("time_of_impact"));
  if (value.contains("time_of_gap")) pair.time_of_gap = read_real(value.at("time_of_gap"));
  if (value.contains("impacts"))
    for (const json& impact : value.at("impacts")) pair.impacts.push_back(read_impact(impact));
  if (value.contains("contact_count")) {
    pair.contact_count = read_whole<std::uint64_t>(value.at("contact_count"));
    return pair;
  }
  for (const json& contact : value.at("contacts")) pair.contacts.push_back(read_contact(contact));
  pair.contact_count = pair.contacts.size();
  return pair;
}

ReportedDiagnostic read_diagnostic(const json& value) {
  ReportedDiagnostic diagnostic;
  if (const json& object = value.at("object"); !object.is_null())
    diagnostic.object = read_whole<std::uint32_t>(object);
  diagnostic.kind = named<DiagnosticKind>(value.at("kind"));
  diagnostic.message = value.at("message").get<std::string>();
  return diagnostic;
}

StepStatistics read_statistics(const json& value) {
  StepStatistics statistics;
  const auto read_all = [&](const auto& fields, auto& part) {
    for (const auto& [name, member] : fields) part.*member = read_whole<std::uint64_t>(value.at(name));
  };
  read_all(count_fields, statistics);
  read_all(work_fields, statistics.work);
  read_all(bytes_fields, statistics.bytes);
  const json& expanded = value.at("regions_expanded");
  if (expanded.size() > statistics.work.regions_expanded.size())
    throw BadLine("regions_expanded has too many levels");
  for (std::size_t level = 0; level < expanded.size(); ++level)
    statistics.work.regions_expanded[level] = read_whole<std::uint64_t>(expanded.at(level));
  if (const auto found = value.find(thread_bytes_field.name); found != value.end())
    statistics.bytes.*thread_bytes_field.member = read_whole<std::uint64_t>(*found);
  for (const auto& [name, member] : time_fields)
    if (const auto found = value.find(name); found != value.end())
      statistics.times.*member = read_real(*found);
  return statistics;
}

ReportedFrame read_frame(const json& value) {
  ReportedFrame frame;
  frame.frame = read_whole<std::uint64_t>(value.at("frame"));
  frame.complete = value.at("complete").get<bool>();
  for (const json& pair : value.at("pairs")) frame.pairs.push_back(read_pair(pair));
  for (const json& diagnostic : value.at("diagnostics"))
    frame.diagnostics.push_back(read_diagnostic(diagnostic));
  frame.statistics = read_statistics(value.at("statistics"));
  return frame;
}

void read_value(const json& value, std::floating_point auto& number) {
  number = read_real(value);
}
template <std::unsigned_integral Whole>
void read_value(const json& value, Whole& number) {
  number = read_whole<Whole>(value);
}
void read_value(const json& value, std::same_as<bool> auto& truth) {
  truth = value.get<bool>();
}
template <NamedEnumeration Enum>
void read_value(const json& value, Enum& enumerator) {
  enumerator = named<Enum>(value);
}
void read_value(const json& value, std::chrono::microseconds& time) {
  time = std::chrono::microseconds(read_whole<std::int64_t>(value));
}
void read_value(const json& value, Accuracy& accuracy) {
  if (value == "exact")
    accuracy = Accuracy::exact();
  else if (value.contains("within"))
    accuracy = Accuracy::within(value.at("within").get<double>());
  else
    accuracy = Accuracy::paper(value.at("paper").get<std::vector<double>>());
}

template <typename Value>
void read_setting(const json& settings, std::string_view key, Value& value) {
  read_value(settings.at(key), value);
}
template <typename Value>
void read_setting(const json& settings, std::string_view key, std::optional<Value>& value) {
  if (settings.contains(key)) read_value(settings.at(key), value.emplace());
}
// A setting that is off is not in the file.
void read_setting(const json& settings, std::string_view key, bool& is_on) {
  if (settings.contains(key)) is_on = settings.at(key).get<bool>();
}
void read_setting(const json& settings, std::string_view key, double& distance) {
  if (settings.contains(key)) read_value(settings.at(key), distance);
}
void read_setting(const json& settings, std::string_view key, std::size_t& most) {
  if (settings.contains(key)) read_value(settings.at(key), most);
}

SceneSettings read_settings(const json& value) {
  SceneSettings settings;
  for_each_reported_setting(
      [&](const auto& field) { read_setting(value, key_of(field), settings.*field.member); });
  return settings;
}

ReportedObject read_object(const json& value) {
  return {read_whole<std::uint32_t>(value.at("id")), value.at("name").get<std::string>(),
          read_whole<std::uint32_t>(value.at("vertices")), read_whole<std::uint32_t>(value.at("faces"))};
}

}  // namespace

struct ReportReader::State {
  explicit State(const std::filesystem::path& file) : path(file.string()), lines(file) {}

  /// Hands the next line, parsed, to `read`. Returns false at the end of the file.
  template <typename Read>
  bool read_line(Read read);
  void read_header(const json& header);

  std::string path;
  ReportLinesIn lines;
  std::size_t line_number = 0;
  std::vector<ReportedObject> objects;
  SceneSettings settings;
  std::uint64_t every = 1;
  bool has_contacts = true;
};

template <typename Read>
bool ReportReader::State::read_line(Read read) {
  std::string line;
  if (!lines.next(line)) return false;
  ++line_number;
  const std::string where = path + ": line " + std::to_string(line_number) + ": ";
  const std::string remedy = "; write the report again with this version of graze";
  try {
    read(json::parse(line));
  } catch (const json::parse_error&) {
    throw InputError(where + "not valid JSON, the file may be cut off" + remedy);
  } catch (const json::exception&) {
    throw InputError(where + "a key is missing or of another type" + remedy);
  } catch (const BadLine& error) {
    throw InputError(where + error.what() + remedy);
  } catch (const Error& error) {
    throw InputError(where + error.what() + remedy);
  }
  return true;
}

void ReportReader::State::read_header(const json& header) {
  if (header.at("graze") != 1) throw BadLine("not version 1 of the format");
  for (const json& object : header.at("objects")) objects.push_back(read_object(object));
  settings = read_settings(header.at("settings"));
  if (header.contains("every")) every = read_whole<std::uint64_t>(header.at("every"));
  has_contacts = header.value("contacts", true);
}

ReportReader::ReportReader(const std::filesystem::path& path) : state_(std::make_unique<State>(path)) {
  if (!state_->read_line([this](const json& header) { state_->read_header(header); }))
    throw InputError(path.string() + ": is empty; write the report again");
}

ReportReader::~ReportReader() = default;
ReportReader::ReportReader(ReportReader&&) noexcept = default;
ReportReader& ReportReader::operator=(ReportReader&&) noexcept = default;

std::span<const ReportedObject> ReportReader::objects() const {
  return state_->objects;
}
const SceneSettings& ReportReader::settings() const {
  return state_->settings;
}
std::uint64_t ReportReader::every() const {
  return state_->every;
}
bool ReportReader::has_contacts() const {
  return state_->has_contacts;
}

std::optional<ReportedFrame> ReportReader::next() {
  ReportedFrame frame;
  if (!state_->read_line([&frame](const json& line) { frame = read_frame(line); })) return std::nullopt;
  return frame;
}

}  // namespace graze::io
