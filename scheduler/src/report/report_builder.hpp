#pragma once

#include <algorithm>
#include <graze/report.hpp>
#include <utility>

#include "core/base/bytes_of.hpp"
#include "core/base/growth_policy.hpp"

namespace graze {

/// The capacity of a report.
struct ReportRoom {
  std::size_t pairs = 0;
  std::size_t contacts = 0;
  std::size_t region_distances = 0;
  std::size_t impacts = 0;

  [[nodiscard]] bool covers(const ReportRoom& other) const {
    return pairs >= other.pairs && contacts >= other.contacts && region_distances >= other.region_distances &&
           impacts >= other.impacts;
  }
  void include(const ReportRoom& other) {
    pairs = std::max(pairs, other.pairs);
    contacts = std::max(contacts, other.contacts);
    region_distances = std::max(region_distances, other.region_distances);
    impacts = std::max(impacts, other.impacts);
  }
};

/// The only class that writes into a report, before the report is published.
class ReportBuilder {
 public:
  explicit ReportBuilder(FrameReport& report) : report_(report) {}

  /// Empties the report and keeps its memory. Its contacts will be overwritten.
  void begin(std::uint64_t frame, std::uint64_t tag) {
    report_.frame_ = frame;
    report_.tag_ = tag;
    report_.complete_ = true;
    report_.shown_ = &report_.rows_;
    report_.rows_.pairs.clear();
    report_.rows_.region_distances.clear();
    report_.rows_.impacts.clear();
    report_.diagnostics_.clear();
    report_.statistics_ = {};
    release_kept();
  }
  /// Appends a pair and its distances of regions, and counts its contacts. The contacts themselves are
  /// written later, in the order of the pairs.
  void add(PairReport pair, std::size_t contact_count, std::span<const RegionDistance> region_distances) {
    pair.first_region_distance = report_.rows_.region_distances.size();
    pair.region_distance_count = region_distances.size();
    report_.rows_.region_distances.insert(report_.rows_.region_distances.end(), region_distances.begin(),
                                          region_distances.end());
    pair.first_contact = contact_count_of_pairs();
    pair.contact_count = contact_count;
    report_.rows_.pairs.push_back(pair);
    report_.complete_ = report_.complete_ && pair.complete;
  }
  /// Appends the impacts of the pair that is added next.
  void add_impacts(PairReport& pair, std::span<const Impact> impacts) {
    if (impacts.empty()) return;
    auto& rows = report_.rows_.impacts;
    pair.first_impact = rows.size();
    pair.impact_count = impacts.size();
    rows.insert(rows.end(), impacts.begin(), impacts.end());
  }
  /// Appends pairs that were adjacent in an earlier report, unchanged, with their distances of regions. They
  /// have no impacts.
  void add_again(std::span<const PairReport> pairs, std::span<const RegionDistance> region_distances) {
    if (pairs.empty()) return;
    auto& rows = report_.rows_;
    const std::size_t contacts = contact_count_of_pairs() - pairs.front().first_contact;
    const std::size_t regions = rows.region_distances.size() - pairs.front().first_region_distance;
    const std::size_t count = rows.pairs.size();
    rows.region_distances.insert(rows.region_distances.end(), region_distances.begin(),
                                 region_distances.end());
    rows.pairs.insert(rows.pairs.end(), pairs.begin(), pairs.end());
    for (PairReport& pair : std::span(rows.pairs).subspan(count)) {
      // If the pairs move forward in the report, these sums wrap modulo 2^64 to the right numbers.
      pair.first_contact += contacts;
      pair.first_region_distance += regions;
      report_.complete_ = report_.complete_ && pair.complete;
    }
  }
  /// The memory for the contacts of all pairs, once all pairs are added. It holds contacts of an earlier
  /// report.
  std::span<Contact> contacts() {
    resize_to_overwrite(report_.rows_.contacts, contact_count_of_pairs());
    return report_.rows_.contacts;
  }
  /// The memory of the contacts, which may serve another purpose until they are written.
  std::vector<Contact>& contact_memory() { return report_.rows_.contacts; }
  /// Swaps a list of contacts with the report's contacts, and moves it to index `first`. All pairs have been
  /// added before. The list gets the memory that the report's contacts had.
  void adopt_contacts(std::vector<Contact>& list, std::size_t first) {
    auto& rows = report_.rows_.contacts;
    rows.swap(list);
    const auto end = static_cast<std::ptrdiff_t>(rows.size());
    if (rows.capacity() < contact_count_of_pairs()) rows.reserve(with_growth_room(contact_count_of_pairs()));
    rows.resize(contact_count_of_pairs(), Contact{});
    if (first > 0)
      std::move_backward(rows.begin(), rows.begin() + end,
                         rows.begin() + static_cast<std::ptrdiff_t>(first) + end);
  }
  /// Makes room for that many contacts in small pieces while `goes_on()` is true. Returns whether there is
  /// room for all.
  template <typename GoesOn>
  bool make_room_while(std::size_t contacts, const GoesOn& goes_on) {
    constexpr std::size_t at_once = 128;
    auto& rows = report_.rows_.contacts;
    if (rows.capacity() < contacts) reserve_to_overwrite(rows, with_growth_room(contacts));
    while (rows.size() < contacts && goes_on())
      rows.resize(std::min(contacts, rows.size() + at_once), Contact{});
    return rows.size() >= contacts;
  }
  /// Shows the rows of another report instead of own ones. That report must not change while this one is
  /// read.
  void show_rows_of(const FrameReport& other) {
    report_.shown_ = other.shown_;
    report_.complete_ = other.complete_;
  }
  /// Copies the rows of another report. It takes memory if there is no room for them.
  void copy_rows_of(const FrameReport& other) {
    report_.rows_ = *other.shown_;
    report_.complete_ = other.complete_;
  }
  [[nodiscard]] std::uint64_t frame() const { return report_.frame_; }
  std::vector<Diagnostic>& diagnostics() { return report_.diagnostics_; }
  StepStatistics& statistics() { return report_.statistics_; }
  void set_geometry(const KeptHandle<KeptGeometry>& geometry) { report_.geometry_ = geometry; }
  void set_meshes(const KeptHandle<KeptMeshes>& meshes) { report_.meshes_ = meshes; }
  void set_patches(const KeptHandle<KeptPatches>& patches) { report_.patches_ = patches; }
  /// Lets go of what the report shares with other reports.
  void release_kept() noexcept {
    report_.geometry_ = {};
    report_.meshes_ = {};
    report_.patches_ = {};
  }

  /// Reserves room in a report that is to be filled. Lists that have to grow lose their content.
  void reserve(const ReportRoom& room) {
    reserve_to_overwrite(report_.rows_.pairs, room.pairs);
    reserve_to_overwrite(report_.rows_.contacts, room.contacts);
    reserve_to_overwrite(report_.rows_.region_distances, room.region_distances);
    reserve_to_overwrite(report_.rows_.impacts, room.impacts);
  }
  /// Frees the rows of the report.
  void release() noexcept {
    report_.shown_ = &report_.rows_;
    report_.rows_ = {};
    release_kept();
  }
  [[nodiscard]] ReportRoom room() const {
    return {report_.rows_.pairs.capacity(), report_.rows_.contacts.capacity(),
            report_.rows_.region_distances.capacity(), report_.rows_.impacts.capacity()};
  }
  [[nodiscard]] std::size_t byte_count() const {
    std::size_t bytes = bytes_of(report_.rows_.pairs) + bytes_of(report_.rows_.contacts) +
                        bytes_of(report_.rows_.region_distances) + bytes_of(report_.rows_.impacts) +
                        bytes_of(report_.diagnostics_);
    for (const Diagnostic& diagnostic : report_.diagnostics_) bytes += diagnostic.message.capacity();
    return bytes;
  }

 private:
  [[nodiscard]] std::size_t contact_count_of_pairs() const {
    if (report_.rows_.pairs.empty()) return 0;
    const PairReport& last = report_.rows_.pairs.back();
    return last.first_contact + last.contact_count;
  }

  FrameReport& report_;
};

}  // namespace graze
