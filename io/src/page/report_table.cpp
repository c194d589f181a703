#include "page/report_table.hpp"

#include <algorithm>
#include <limits>

#include "report/report_fields.hpp"

namespace graze::io {
namespace {

enum PairFlag : std::uint8_t { incomplete = 1, stale = 2, contacts_cut = 4 };

PageColumns::Column bytes_column(std::string_view name) {
  return {name, "u8", sizeof(std::uint8_t), 1};
}
PageColumns::Column words_column(std::string_view name, std::size_t count) {
  return {name, "u32", sizeof(std::uint32_t), count};
}
PageColumns::Column reals_column(std::string_view name, std::size_t count) {
  return {name, "f64", sizeof(double), count};
}

void put_feature(PageColumns& row, const Feature& feature) {
  row.put(static_cast<std::uint32_t>(feature.kind)).put(feature.index);
}

void put_point(PageColumns& row, const Eigen::Vector3d& point) {
  for (const double coordinate : point) row.put(coordinate);
}

std::uint8_t flags_of(const PairReport& pair) {
  const int flags =
      (pair.complete ? 0 : incomplete) | (pair.stale ? stale : 0) | (pair.contacts_cut ? contacts_cut : 0);
  return static_cast<std::uint8_t>(flags);
}

std::uint32_t as_word(std::uint64_t number) {
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(number, std::numeric_limits<std::uint32_t>::max()));
}

void add_contact(PageColumns& contacts, const Contact& contact, std::uint64_t since) {
  const int sides =
      static_cast<int>(contact.side_a) + 4 * static_cast<int>(contact.side_b) + (contact.sunk ? 16 : 0);
  contacts.begin_row().put(static_cast<std::uint8_t>(contact.kind)).put(static_cast<std::uint8_t>(sides));
  put_feature(contacts, contact.feature_a);
  put_feature(contacts, contact.feature_b);
  put_point(contacts, contact.point_a);
  put_point(contacts, contact.point_b);
  put_point(contacts, contact.normal);
  contacts.put(contact.distance).put(as_word(since));
}

void add_region_distance(PageColumns& regions, const RegionDistance& distance) {
  regions.begin_row().put(distance.level);
  regions.put(distance.region_a).put(distance.region_b).put(distance.vertex_a).put(distance.vertex_b);
  put_point(regions, distance.point_a);
  put_point(regions, distance.point_b);
  regions.put(distance.distance);
}

void add_way_out(PageColumns& ways, const WayOut& way) {
  ways.begin_row();
  put_point(ways, way.direction);
  put_point(ways, way.point);
  ways.put(way.fullness).put(way.thickness).put(way.extent);
}

/// Whether the lists of some pairs have the same lengths. `begins` has where the list of each pair begins.
bool have_same_lengths(const std::vector<std::uint32_t>& begins, std::size_t a, std::size_t b,
                       std::size_t count) {
  for (std::size_t i = 1; i <= count; ++i)
    if (begins[a + i] - begins[a] != begins[b + i] - begins[b]) return false;
  return true;
}

}  // namespace

PageColumns& PageColumns::begin_row() {
  ++rows_;
  next_ = 0;
  filled_ = 0;
  return *this;
}

bool PageColumns::are_same(std::size_t a, std::size_t b, std::size_t count) const {
  return std::ranges::all_of(columns_, [&](const Column& column) {
    const std::size_t row_bytes = column.number_bytes * column.row_numbers;
    const std::string_view bytes = column.bytes;
    return bytes.substr(a * row_bytes, count * row_bytes) == bytes.substr(b * row_bytes, count * row_bytes);
  });
}

void PageColumns::truncate(std::size_t rows) {
  for (Column& column : columns_) column.bytes.resize(rows * column.number_bytes * column.row_numbers);
  rows_ = rows;
}

void PageColumns::add_to(PageTable& table) const {
  for (const Column& column : columns_)
    table.add_bytes(column.name, column.type, column.bytes, rows_ * column.row_numbers);
}

ReportBlock::ReportBlock()
    : pairs_({words_column("pair_a", 1), words_column("pair_b", 1), bytes_column("pair_phase"),
              bytes_column("pair_flags"), bytes_column("pair_inside"), reals_column("pair_lower", 1),
              reals_column("pair_upper", 1), words_column("witness_features", 4),
              reals_column("witness_points", 6)}),
      contact_begin_{0},
      region_begin_{0},
      way_begin_{0},
      contacts_({bytes_column("contact_kind"), bytes_column("contact_sides"),
                 words_column("contact_features", 4), reals_column("contact_points", 6),
                 reals_column("contact_normal", 3), reals_column("contact_distance", 1),
                 words_column("contact_since", 1)}),
      regions_({words_column("region_levels", 1), words_column("region_ids", 4),
                reals_column("region_points", 6), reals_column("region_distance", 1)}),
      ways_({reals_column("way_direction", 3), reals_column("way_point", 3), reals_column("way_fullness", 1),
             reals_column("way_thickness", 1), reals_column("way_extent", 1)}) {
  diagnostics_.open('[');
  infos_.open('[');
}

void ReportBlock::add_pair(std::uint64_t number, const FrameReport& report, const PairReport& pair,
                           const IndexOf& index_of) {
  pairs_.begin_row().put(index_of(pair.a).value()).put(index_of(pair.b).value());
  pairs_.put(static_cast<std::uint8_t>(pair.phase)).put(flags_of(pair));
  pairs_.put(static_cast<std::uint8_t>(pair.inside));
  pairs_.put(pair.distance.lower).put(pair.distance.upper);
  put_feature(pairs_, pair.witness.feature_a);
  put_feature(pairs_, pair.witness.feature_b);
  put_point(pairs_, pair.witness.point_a);
  put_point(pairs_, pair.witness.point_b);
  for (const Contact& contact : report.contacts(pair))
    add_contact(contacts_, contact, since_in_file(contact.since, number, report));
  for (const RegionDistance& distance : report.region_distances(pair))
    add_region_distance(regions_, distance);
  if (is_written(pair.way_out)) add_way_out(ways_, pair.way_out);
  contact_begin_.push_back(static_cast<std::uint32_t>(contacts_.size()));
  region_begin_.push_back(static_cast<std::uint32_t>(regions_.size()));
  way_begin_.push_back(static_cast<std::uint32_t>(ways_.size()));
}

void ReportBlock::add_diagnostics(std::uint64_t page_frame, const FrameReport& report,
                                  const IndexOf& index_of) {
  for (const Diagnostic& diagnostic : report.diagnostics()) {
    diagnostics_.open('{').key("frame").whole(page_frame).key("object");
    if (const auto object = index_of(diagnostic.object))
      diagnostics_.whole(*object);
    else
      diagnostics_.null();
    diagnostics_.key("kind").text(to_string(diagnostic.kind)).key("message").text(diagnostic.message);
    diagnostics_.close('}');
  }
}

void ReportBlock::add_info(std::uint64_t number, const FrameReport& report, bool include_times) {
  infos_.open('{').key("frame").whole(number).key("tag").text(std::to_string(report.tag()));
  infos_.key("complete").flag(report.complete()).key("statistics");
  write_statistics(infos_, report.statistics(), include_times);
  infos_.close('}');
}

bool ReportBlock::repeat_last(const Range& rows) const {
  const std::size_t count = rows.end - rows.begin;
  if (frames_.empty() || last_.end - last_.begin != count) return false;
  const auto lists_repeat = [&](const PageColumns& lists, const Numbers& begins) {
    return have_same_lengths(begins, last_.begin, rows.begin, count) &&
           lists.are_same(begins[last_.begin], begins[rows.begin], begins[rows.end] - begins[rows.begin]);
  };
  return pairs_.are_same(last_.begin, rows.begin, count) && lists_repeat(contacts_, contact_begin_) &&
         lists_repeat(regions_, region_begin_) && lists_repeat(ways_, way_begin_);
}

void ReportBlock::truncate_pairs(std::size_t count) {
  pairs_.truncate(count);
  contacts_.truncate(contact_begin_[count]);
  regions_.truncate(region_begin_[count]);
  ways_.truncate(way_begin_[count]);
  contact_begin_.resize(count + 1);
  region_begin_.resize(count + 1);
  way_begin_.resize(count + 1);
}

void ReportBlock::add(std::uint64_t page_frame, std::uint64_t number, const FrameReport& report,
                      const IndexOf& index_of, bool include_times) {
  const std::size_t begin = pairs_.size();
  for (const PairReport& pair : report.pairs()) add_pair(number, report, pair, index_of);
  const Range rows{begin, pairs_.size()};
  if (repeat_last(rows))
    truncate_pairs(begin);
  else
    last_ = rows;
  frames_.push_back(last_);
  add_diagnostics(page_frame, report, index_of);
  add_info(number, report, include_times);
}

std::vector<std::uint32_t> ReportBlock::pairs_with_way_out() const {
  Numbers pairs;
  for (std::uint32_t pair = 0; pair < pairs_.size(); ++pair)
    if (way_begin_[pair] < way_begin_[pair + 1]) pairs.push_back(pair);
  return pairs;
}

std::string ReportBlock::table() const {
  PageTable table;
  const auto add_numbers = [&table](std::string_view name, std::span<const std::uint32_t> numbers) {
    table.add(name, numbers);
  };
  Numbers frame_begin;
  Numbers frame_end;
  for (const Range& rows : frames_) {
    frame_begin.push_back(static_cast<std::uint32_t>(rows.begin));
    frame_end.push_back(static_cast<std::uint32_t>(rows.end));
  }
  add_numbers("frame_pair_begin", frame_begin);
  add_numbers("frame_pair_end", frame_end);
  pairs_.add_to(table);
  const std::size_t count = pairs_.size();
  add_numbers("pair_contact_begin", std::span(contact_begin_).first(count));
  add_numbers("pair_contact_end", std::span(contact_begin_).subspan(1));
  add_numbers("pair_region_begin", std::span(region_begin_).first(count));
  add_numbers("pair_region_end", std::span(region_begin_).subspan(1));
  contacts_.add_to(table);
  regions_.add_to(table);
  if (ways_.size() > 0) {
    add_numbers("way_pair", pairs_with_way_out());
    ways_.add_to(table);
  }
  table.add_key("diagnostics", diagnostics_.line() + "]");
  table.add_key("frames_info", infos_.line() + "]");
  return table.bytes();
}

}  // namespace graze::io
