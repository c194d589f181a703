#include <algorithm>
#include <graze/io/table_writers.hpp>
#include <span>

#include "export/csv_line.hpp"
#include "export/output_file.hpp"
#include "export/snapshot_objects.hpp"
#include "report/report_fields.hpp"

namespace graze::io {
namespace {

constexpr std::string_view contact_columns =
    "frame,scene_frame,object_a,object_b,name_a,name_b,kind,side_a,side_b,feature_kind_a,feature_a,"
    "feature_kind_b,feature_b,point_a_x,point_a_y,point_a_z,point_b_x,point_b_y,point_b_z,normal_x,normal_y,"
    "normal_z,distance,since,separation,push_x,push_y,push_z,sunk\n";
constexpr std::string_view distance_columns =
    "frame,scene_frame,object_a,object_b,name_a,name_b,phase,distance_lower,distance_upper,witness_kind_a,"
    "witness_a,witness_kind_b,witness_b,witness_a_x,witness_a_y,witness_a_z,witness_b_x,witness_b_y,"
    "witness_b_z,contacts,complete,contacts_cut,stale,inside,way_direction_x,way_direction_y,way_direction_z,"
    "way_point_x,way_point_y,way_point_z,way_fullness,way_thickness,way_extent,deepest_separation\n";

void add_feature(CsvLine& line, const Feature& feature) {
  line.text(to_string(feature.kind)).whole(feature.index);
}

/// The cells with which both tables begin. Those of an object that the snapshot does not have stay empty.
void begin_line(CsvLine& line, const SceneSnapshot& snapshot, const PairReport& pair,
                const SnapshotObjects& objects) {
  line.whole(snapshot.frame).whole(snapshot.scene_frame);
  const std::array<const SnapshotObject*, 2> both{objects.find(pair.a), objects.find(pair.b)};
  for (const SnapshotObject* object : both) object != nullptr ? line.whole(object->serial) : line.empty();
  for (const SnapshotObject* object : both) object != nullptr ? line.text(object->name) : line.empty();
}

std::uint64_t exported_since(const SceneSnapshot& snapshot, std::uint64_t since) {
  return since < snapshot.frames_by_since.size() ? snapshot.frames_by_since[since] : since;
}

void end_contact(CsvLine& line, const Contact& contact, std::uint64_t since) {
  line.text(to_string(contact.kind)).text(to_string(contact.side_a)).text(to_string(contact.side_b));
  add_feature(line, contact.feature_a);
  add_feature(line, contact.feature_b);
  line.point(contact.point_a).point(contact.point_b).point(contact.normal);
  line.real(contact.distance).whole(since).real(contact.separation()).point(contact.push());
  line.flag(contact.sunk).end();
}

/// The cells of a row without a way out stay empty.
void add_way_out(CsvLine& line, const WayOut& way) {
  constexpr int cells = 9;
  if (is_written(way))
    line.point(way.direction).point(way.point).real(way.fullness).real(way.thickness).real(way.extent);
  else
    for (int i = 0; i < cells; ++i) line.empty();
}

/// The smallest separation of contacts. Without one the cell stays empty.
void add_deepest(CsvLine& line, std::span<const Contact> contacts) {
  const auto deepest = std::ranges::min_element(contacts, {}, &Contact::separation);
  deepest == contacts.end() ? line.empty() : line.real(deepest->separation());
}

void end_row(CsvLine& line, const PairReport& pair, std::span<const Contact> contacts) {
  line.text(to_string(pair.phase)).real(pair.distance.lower).real(pair.distance.upper);
  add_feature(line, pair.witness.feature_a);
  add_feature(line, pair.witness.feature_b);
  line.point(pair.witness.point_a).point(pair.witness.point_b).whole(pair.contact_count);
  line.flag(pair.complete).flag(pair.contacts_cut).flag(pair.stale).text(to_string(pair.inside));
  add_way_out(line, pair.way_out);
  add_deepest(line, contacts);
  line.end();
}

/// A file of lines below their column names.
struct TableFile {
  TableFile(const std::filesystem::path& path, std::string_view columns) : file(path) { file.write(columns); }
  void flush() {
    file.write(line.lines());
    line.clear();
  }

  OutputFile file;
  CsvLine line;
  std::uint64_t rows = 0;
};

}  // namespace

struct ContactTable::State : TableFile {
  using TableFile::TableFile;
};

ContactTable::ContactTable(const std::filesystem::path& path)
    : state_(std::make_unique<State>(path, contact_columns)) {}
ContactTable::~ContactTable() = default;
ContactTable::ContactTable(ContactTable&&) noexcept = default;
ContactTable& ContactTable::operator=(ContactTable&&) noexcept = default;

void ContactTable::write(const SceneSnapshot& snapshot) {
  const SnapshotObjects objects(snapshot);
  for (const PairReport& pair : snapshot.report->pairs())
    for (const Contact& contact : snapshot.report->contacts(pair)) {
      begin_line(state_->line, snapshot, pair, objects);
      end_contact(state_->line, contact, exported_since(snapshot, contact.since));
      ++state_->rows;
    }
  state_->flush();
}

void ContactTable::close() {
  state_->file.close();
}

std::uint64_t ContactTable::row_count() const {
  return state_->rows;
}

struct DistanceTable::State : TableFile {
  using TableFile::TableFile;
};

DistanceTable::DistanceTable(const std::filesystem::path& path)
    : state_(std::make_unique<State>(path, distance_columns)) {}
DistanceTable::~DistanceTable() = default;
DistanceTable::DistanceTable(DistanceTable&&) noexcept = default;
DistanceTable& DistanceTable::operator=(DistanceTable&&) noexcept = default;

void DistanceTable::write(const SceneSnapshot& snapshot) {
  const SnapshotObjects objects(snapshot);
  for (const PairReport& pair : snapshot.report->pairs()) {
    begin_line(state_->line, snapshot, pair, objects);
    end_row(state_->line, pair, snapshot.report->contacts(pair));
    ++state_->rows;
  }
  state_->flush();
}

void DistanceTable::close() {
  state_->file.close();
}

std::uint64_t DistanceTable::row_count() const {
  return state_->rows;
}

}  // namespace graze::io
