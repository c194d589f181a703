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

}  // namespace graze
