#include <graze/report.hpp>

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

std::string_view to_string(DiagnosticKind kind) {
  switch (kind) {
    case DiagnosticKind::stale_id:
      return "stale_id";
    case DiagnosticKind::wrong_count:
      return "wrong_count";
    case DiagnosticKind::null_memory:
      return "null_memory";
    case DiagnosticKind::misaligned_memory:
      return "misaligned_memory";
    case DiagnosticKind::wrong_motion:
      return "wrong_motion";
    case DiagnosticKind::bad_pose:
      return "bad_pose";
    case DiagnosticKind::not_finite:
      return "not_finite";
    case DiagnosticKind::too_large:
      return "too_large";
    case DiagnosticKind::broken_promise:
      return "broken_promise";
    case DiagnosticKind::bad_pair:
      return "bad_pair";
    case DiagnosticKind::bad_rule:
      return "bad_rule";
    case DiagnosticKind::out_of_memory:
      return "out_of_memory";
  }
  return "unknown";
}

std::string_view to_string(PairPhase phase) {
  switch (phase) {
    case PairPhase::near:
      return "near";
    case PairPhase::began:
      return "began";
    case PairPhase::touching:
      return "touching";
    case PairPhase::ended:
      return "ended";
  }
  return "unknown";
}

std::string_view to_string(Inside inside) {
  switch (inside) {
    case Inside::none:
      return "none";
    case Inside::a_in_b:
      return "a_in_b";
    case Inside::b_in_a:
      return "b_in_a";
    case Inside::crossing:
      return "crossing";
  }
  return "unknown";
}

std::string_view to_string(ContactKind kind) {
  switch (kind) {
    case ContactKind::VV:
      return "VV";
    case ContactKind::VE:
      return "VE";
    case ContactKind::VF:
      return "VF";
    case ContactKind::EE:
      return "EE";
    case ContactKind::EF:
      return "EF";
    case ContactKind::FF:
      return "FF";
  }
  return "unknown";
}

std::string_view to_string(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::vertex:
      return "vertex";
    case FeatureKind::edge:
      return "edge";
    case FeatureKind::face:
      return "face";
  }
  return "unknown";
}

std::string_view to_string(Side side) {
  switch (side) {
    case Side::none:
      return "none";
    case Side::front:
      return "front";
    case Side::back:
      return "back";
  }
  return "unknown";
}

}  // namespace graze
