#include <algorithm>
#include <cstddef>
#include <cstring>

#include "calls.hpp"
#include "handles.hpp"
#include "layout.hpp"
#include "positions.hpp"

using graze::FrameReport;
using graze::c::c_rows;
using graze::c::given;
using graze::c::guarded;
using graze::c::same;

namespace {

const FrameReport& read_report(const graze_report* report) {
  return given(report, "report").report();
}

/// Gives rows of a report, or none for a null handle.
template <typename Row, typename Rows>
const Row* rows_of(const graze_report* report, size_t* count, const Rows& rows) {
  if (count != nullptr) *count = 0;
  return report != nullptr ? c_rows<Row>(rows(report->report()), count) : nullptr;
}

/// The parts of the C++ struct follow each other as they do in the struct of C. All are numbers of 8 bytes.
graze_statistics flat(const graze::StepStatistics& step) {
  static_assert(offsetof(graze_statistics, boxes_tested) == offsetof(graze::StepStatistics, work));
  static_assert(offsetof(graze_statistics, object_bytes) == offsetof(graze::StepStatistics, bytes));
  static_assert(offsetof(graze_statistics, read_ms) == offsetof(graze::StepStatistics, times));
  return same<graze_statistics>(step);
}

}  // namespace

extern "C" {

graze_status graze_report_share(const graze_report* report, graze_report** shared) {
  return guarded([&] {
    const graze_report& read = given(report, "report");
    auto made = std::make_unique<graze_report>();
    made->handle = read.handle;
    if (read.copy) made->copy = std::make_unique<const FrameReport>(*read.copy);
    given(shared, "shared") = made.release();
  });
}

graze_status graze_report_copy(const graze_report* report, graze_report** copy) {
  return guarded([&] {
    auto made = std::make_unique<graze_report>();
    made->copy = std::make_unique<const FrameReport>(read_report(report));
    given(copy, "copy") = made.release();
  });
}

void graze_report_release(graze_report* report) {
  delete report;
}

uint64_t graze_report_frame(const graze_report* report) {
  return report ? report->report().frame() : 0;
}

uint64_t graze_report_tag(const graze_report* report) {
  return report ? report->report().tag() : 0;
}

bool graze_report_complete(const graze_report* report) {
  return report != nullptr && report->report().complete();
}

const graze_pair* graze_report_pairs(const graze_report* report, size_t* count) {
  return rows_of<graze_pair>(report, count, [](const FrameReport& read) { return read.pairs(); });
}

const graze_contact* graze_report_contacts(const graze_report* report, size_t* count) {
  return rows_of<graze_contact>(report, count, [](const FrameReport& read) { return read.contacts(); });
}

const graze_region_distance* graze_report_region_distances(const graze_report* report, size_t* count) {
  return rows_of<graze_region_distance>(report, count,
                                        [](const FrameReport& read) { return read.region_distances(); });
}

const graze_impact* graze_report_impacts(const graze_report* report, size_t* count) {
  return rows_of<graze_impact>(report, count, [](const FrameReport& read) { return read.impacts(); });
}

size_t graze_report_diagnostic_count(const graze_report* report) {
  return report ? report->report().diagnostics().size() : 0;
}

graze_status graze_report_diagnostic(const graze_report* report, size_t index, graze_diagnostic* diagnostic) {
  return guarded([&] {
    const auto all = read_report(report).diagnostics();
    if (index >= all.size())
      throw graze::c::BadArgument("index is " + std::to_string(index) + " of " + std::to_string(all.size()));
    const graze::Diagnostic& read = all[index];
    given(diagnostic, "diagnostic") = {same<graze_id>(read.object), static_cast<uint8_t>(read.kind),
                                       read.message.c_str()};
  });
}

graze_status graze_report_statistics(const graze_report* report, graze_statistics* statistics,
                                     size_t struct_size) {
  return guarded([&] {
    const graze_statistics all = flat(read_report(report).statistics());
    std::memcpy(&given(statistics, "statistics"), &all, std::min(struct_size, sizeof all));
  });
}

graze_status graze_report_mesh(const graze_report* report, graze_id object, graze_mesh** mesh) {
  return guarded([&] { graze::c::give_mesh(read_report(report).mesh(same<graze::ObjectId>(object)), mesh); });
}

graze_status graze_report_positions(const graze_report* report, graze_id object, graze_positions* positions) {
  return guarded([&] {
    given(positions, "positions") =
        graze::c::described(read_report(report).positions(same<graze::ObjectId>(object)));
  });
}

}  // extern "C"
