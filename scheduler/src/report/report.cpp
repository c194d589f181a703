#include <graze/report.hpp>
#include <graze/scene_enumerators.hpp>

namespace graze {

FrameReport::FrameReport(const FrameReport& other)
    : frame_(other.frame_),
      tag_(other.tag_),
      complete_(other.complete_),
      rows_(*other.shown_),
      diagnostics_(other.diagnostics_),
      statistics_(other.statistics_) {}

FrameReport& FrameReport::operator=(const FrameReport& other) {
  if (this == &other) return *this;
  frame_ = other.frame_;
  tag_ = other.tag_;
  complete_ = other.complete_;
  rows_ = *other.shown_;
  shown_ = &rows_;
  diagnostics_ = other.diagnostics_;
  statistics_ = other.statistics_;
  return *this;
}

namespace {

std::string_view known(std::string_view name) {
  return name.empty() ? "unknown" : name;
}

}  // namespace

std::string_view to_string(DiagnosticKind kind) {
  return known(name_of(kind));
}
std::string_view to_string(PairPhase phase) {
  return known(name_of(phase));
}
std::string_view to_string(Inside inside) {
  return known(name_of(inside));
}
std::string_view to_string(ContactKind kind) {
  return known(name_of(kind));
}
std::string_view to_string(FeatureKind kind) {
  return known(name_of(kind));
}
std::string_view to_string(Side side) {
  return known(name_of(side));
}

}  // namespace graze
