#pragma once

#include <graze/report.hpp>

namespace graze {

/// The one place that writes into a report, before it is published.
class ReportBuilder {
 public:
  explicit ReportBuilder(FrameReport& report) : report_(report) {}

  /// Empties the report and keeps its memory.
  void begin(std::uint64_t frame) {
    report_.frame_ = frame;
    report_.complete_ = true;
    report_.pairs_.clear();
    report_.contacts_.clear();
    report_.region_distances_.clear();
    report_.diagnostics_.clear();
    report_.statistics_ = {};
  }
  /// Appends a pair with what belongs to it, and gives its contacts back for what else is to be said of them.
  std::span<Contact> add(PairReport pair, std::span<const Contact> contacts,
                         std::span<const RegionDistance> region_distances) {
    pair.first_region_distance = report_.region_distances_.size();
    pair.region_distance_count = region_distances.size();
    report_.region_distances_.insert(report_.region_distances_.end(), region_distances.begin(),
                                     region_distances.end());
    pair.first_contact = report_.contacts_.size();
    pair.contact_count = contacts.size();
    report_.contacts_.insert(report_.contacts_.end(), contacts.begin(), contacts.end());
    report_.pairs_.push_back(pair);
    report_.complete_ = report_.complete_ && pair.complete;
    return std::span(report_.contacts_).subspan(pair.first_contact);
  }
  std::vector<Diagnostic>& diagnostics() { return report_.diagnostics_; }
  StepStatistics& statistics() { return report_.statistics_; }
  [[nodiscard]] std::size_t byte_count() const {
    return report_.pairs_.capacity() * sizeof(PairReport) + report_.contacts_.capacity() * sizeof(Contact) +
           report_.region_distances_.capacity() * sizeof(RegionDistance) +
           report_.diagnostics_.capacity() * sizeof(Diagnostic);
  }

 private:
  FrameReport& report_;
};

}  // namespace graze
