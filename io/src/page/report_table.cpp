#include "page/report_table.hpp"

#include <algorithm>
#include <array>
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

/// Whether a pair met or came near between two steps.
bool has_sweep(const PairReport& pair) {
  return pair.time_of_impact < 1 || pair.time_of_gap < 1 || pair.impact_count > 0;
}

void add_impact(PageColumns& impacts, const Impact& impact) {
  impacts.begin_row().put(static_cast<std::uint8_t>(impact.kind));
  impacts.put(static_cast<std::uint8_t>(impact.status));
  put_feature(impacts, impact.feature_a);
  put_feature(impacts, impact.feature_b);
  impacts.put(impact.lower).put(impact.upper);
}

}  // namespace

PageColumns& PageColumns::begin_row() {
  ++rows_;
  next_ = 0;
  filled_ = 0;
  return *this;
}

bool PageColumns::are_same(std::size_t a, std::size_t b, std::size_t count) const {
  return std::all_of(columns_.begin(), columns_.end(), [&](const Column& column) {
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

std::vector<std::uint32_t> PairLists::pairs() const {
  Numbers pairs;
  for (std::uint32_t pair = 0; pair + 1 < begins_.size(); ++pair)
    if (begins_[pair] < begins_[pair + 1]) pairs.push_back(pair);
  return pairs;
}

bool PairLists::are_same(std::size_t a, std::size_t b, std::size_t count) const {
  for (std::size_t i = 1; i <= count; ++i)
    if (begins_[a + i] - begins_[a] != begins_[b + i] - begins_[b]) return false;
  return rows_.are_same(begins_[a], begins_[b], begins_[b + count] - begins_[b]);
}

void PairLists::truncate(std::size_t pairs) {
  rows_.truncate(begins_[pairs]);
  begins_.resize(pairs + 1);
}

ReportBlock::ReportBlock()
    : pairs_({words_column("pair_a", 1), words_column("pair_b", 1), bytes_column("pair_phase"),
              bytes_column("pair_flags"), bytes_column("pair_inside"), reals_column("pair_lower", 1),
              reals_column("pair_upper", 1), words_column("witness_features", 4),
              reals_column("witness_points", 6)}),
      contacts_({bytes_column("contact_kind"), bytes_column("contact_sides"),
                 words_column("contact_features", 4), reals_column("contact_points", 6),
                 reals_column("contact_normal", 3), reals_column("contact_distance", 1),
                 words_column("contact_since", 1)}),
      regions_({words_column("region_levels", 1), words_column("region_ids", 4),
                reals_column("region_points", 6), reals_column("region_distance", 1)}),
      ways_({reals_column("way_direction", 3), reals_column("way_point", 3), reals_column("way_fullness", 1),
             reals_column("way_thickness", 1), reals_column("way_extent", 1)}),
      sweeps_({reals_column("sweep_time_of_impact", 1), reals_column("sweep_time_of_gap", 1)}),
      impacts_({bytes_column("impact_kind"), bytes_column("impact_status"),
                words_column("impact_features", 4), reals_column("impact_times", 2)}) {
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
    add_contact(contacts_.rows(), contact, since_in_file(contact.since, number, report));
  for (const RegionDistance& distance : report.region_distances(pair))
    add_region_distance(regions_.rows(), distance);
  if (is_written(pair.way_out)) add_way_out(ways_.rows(), pair.way_out);
  if (has_sweep(pair)) sweeps_.rows().begin_row().put(pair.time_of_impact).put(pair.time_of_gap);
  for (const Impact& impact : report.impacts(pair)) add_impact(impacts_.rows(), impact);
  for (PairLists* const lists : {&contacts_, &regions_, &ways_, &sweeps_, &impacts_}) lists->end_pair();
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
  const std::array all_lists{&contacts_, &regions_, &ways_, &sweeps_, &impacts_};
  return pairs_.are_same(last_.begin, rows.begin, count) &&
         std::all_of(all_lists.begin(), all_lists.end(),
                     [&](const PairLists* lists) { return lists->are_same(last_.begin, rows.begin, count); });
}

void ReportBlock::truncate_pairs(std::size_t count) {
  pairs_.truncate(count);
  for (PairLists* const lists : {&contacts_, &regions_, &ways_, &sweeps_, &impacts_}) lists->truncate(count);
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

void ReportBlock::add_sweeps_to(PageTable& table) const {
  const std::vector<std::uint32_t> pairs = sweeps_.pairs();
  std::vector<std::uint32_t> begins;
  std::vector<std::uint32_t> ends;
  for (const std::uint32_t pair : pairs) {
    begins.push_back(impacts_.begin(pair));
    ends.push_back(impacts_.begin(pair + 1));
  }
  table.add("sweep_pair", std::span(pairs));
  sweeps_.rows().add_to(table);
  table.add("sweep_impact_begin", std::span<const std::uint32_t>(begins));
  table.add("sweep_impact_end", std::span<const std::uint32_t>(ends));
  impacts_.rows().add_to(table);
}

std::string ReportBlock::table() const {
  PageTable table;
  const auto add_numbers = [&table](std::string_view name, std::span<const std::uint32_t> numbers) {
    table.add(name, numbers);
  };
  std::vector<std::uint32_t> frame_begin;
  std::vector<std::uint32_t> frame_end;
  for (const Range& rows : frames_) {
    frame_begin.push_back(static_cast<std::uint32_t>(rows.begin));
    frame_end.push_back(static_cast<std::uint32_t>(rows.end));
  }
  add_numbers("frame_pair_begin", frame_begin);
  add_numbers("frame_pair_end", frame_end);
  pairs_.add_to(table);
  add_numbers("pair_contact_begin", contacts_.begins());
  add_numbers("pair_contact_end", contacts_.ends());
  add_numbers("pair_region_begin", regions_.begins());
  add_numbers("pair_region_end", regions_.ends());
  contacts_.rows().add_to(table);
  regions_.rows().add_to(table);
  if (ways_.rows().size() > 0) {
    add_numbers("way_pair", ways_.pairs());
    ways_.rows().add_to(table);
  }
  if (sweeps_.rows().size() > 0) add_sweeps_to(table);
  table.add_key("diagnostics", diagnostics_.line() + "]");
  table.add_key("frames_info", infos_.line() + "]");
  return table.bytes();
}

}  // namespace graze::io
