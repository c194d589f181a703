#include <graze/report.hpp>
#include <graze/scene_enumerators.hpp>

#include "geometry/kept_geometry.hpp"

namespace graze {

FrameReport::FrameReport(const FrameReport& other)
    : frame_(other.frame_),
      tag_(other.tag_),
      complete_(other.complete_),
      rows_(*other.shown_),
      diagnostics_(other.diagnostics_),
      statistics_(other.statistics_),
      geometry_(other.geometry_) {}

FrameReport& FrameReport::operator=(const FrameReport& other) {
  if (this == &other) return *this;
  frame_ = other.frame_;
  tag_ = other.tag_;
  complete_ = other.complete_;
  rows_ = *other.shown_;
  shown_ = &rows_;
  diagnostics_ = other.diagnostics_;
  statistics_ = other.statistics_;
  geometry_ = other.geometry_;
  return *this;
}

std::shared_ptr<const Mesh> FrameReport::mesh(ObjectId object) const {
  const KeptObject* const kept = geometry_.get() == nullptr ? nullptr : geometry_.get()->find(object);
  return kept == nullptr ? nullptr : kept->surface->mesh;
}

PositionView FrameReport::positions(ObjectId object) const {
  const KeptObject* const kept = geometry_.get() == nullptr ? nullptr : geometry_.get()->find(object);
  return kept == nullptr ? PositionView() : kept->surface->surface.positions();
}

}  // namespace graze
