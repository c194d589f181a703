#pragma once

#include <graze/graze.h>

#include <memory>
#include <utility>

#include "handles.hpp"

namespace graze::c {

/// Puts a report into the caller's handle, or into a new one. A new handle is made before the function does
/// anything, so that no step is lost for lack of memory.
class ReportRoom {
 public:
  /// `room` may be null, and then nobody wants the report.
  explicit ReportRoom(graze_report** room) : room_(room) {
    if (room_ != nullptr && *room_ == nullptr) made_ = std::make_unique<graze_report>();
  }

  void take(ReportHandle report) {
    if (room_ == nullptr) return;
    if (made_) *room_ = made_.release();
    (*room_)->copy.reset();
    (*room_)->handle = std::move(report);
  }

 private:
  graze_report** room_;
  std::unique_ptr<graze_report> made_;
};

}  // namespace graze::c
