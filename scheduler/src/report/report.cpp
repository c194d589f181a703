#include <graze/report.hpp>
#include <graze/scene_enumerators.hpp>

#include "geometry/kept_geometry.hpp"
#include "geometry/kept_meshes.hpp"
#include "patches/kept_patches.hpp"

namespace graze {

FrameReport::FrameReport(const FrameReport& other)
    : frame_(other.frame_),
      tag_(other.tag_),
      complete_(other.complete_),
      rows_(*other.shown_),
      diagnostics_(other.diagnostics_),
      statistics_(other.statistics_),
      geometry_(other.geometry_),
      meshes_(other.meshes_),
      patches_(other.patches_) {}

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
  meshes_ = other.meshes_;
  patches_ = other.patches_;
  return *this;
}

std::shared_ptr<const Mesh> FrameReport::mesh(ObjectId object) const {
  const auto* const kept = meshes_.get() == nullptr ? nullptr : meshes_.get()->find(object);
  return kept == nullptr ? nullptr : *kept;
}

PositionView FrameReport::positions(ObjectId object) const {
  const KeptObject* const kept = geometry_.get() == nullptr ? nullptr : geometry_.get()->find(object);
  return kept == nullptr ? PositionView() : kept->surface->surface.positions();
}

Patch FrameReport::patch(ObjectId tool) const {
  return Patch(patches_.get() == nullptr ? nullptr : patches_.get()->find(tool));
}

}  // namespace graze
