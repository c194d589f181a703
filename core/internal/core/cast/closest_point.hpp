#pragma once

#include <Eigen/Core>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <memory>
#include <optional>

#include "core/mesh/face_groups.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Finds the point of a surface that is closest to a point. Keeps its working memory. One thread at a time.
class GRAZE_API ClosestPointSearch {
 public:
  ClosestPointSearch();
  ~ClosestPointSearch();
  ClosestPointSearch(ClosestPointSearch&&) noexcept;
  ClosestPointSearch& operator=(ClosestPointSearch&&) noexcept;

  /// Returns the contact of the point, as a's only vertex, with the surface as b. It is the one that a pair
  /// of surfaces would have. Returns nothing where the distance is not below `limit`. Faces that `groups`
  /// hides do not count. A null pointer hides none. The surface has been refitted for faces now.
  std::optional<Contact> find(const Eigen::Vector3d& point, const Surface& surface, const FaceGroups* groups,
                              double limit);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace graze
