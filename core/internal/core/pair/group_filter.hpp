#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/export.hpp>
#include <memory>
#include <vector>

#include "core/mesh/face_groups.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/pair/near_list.hpp"

namespace graze {

/// Says which features of two surfaces may be tested against each other, by the groups of their faces.
///
/// Two features may be if some face of the one and some face of the other are not hidden, and in groups that
/// are not ignored. A fold belongs to its quad. So exactly those features are tested that belong to two
/// faces that are. This one ignores no groups. It refers to the groups of both meshes, and takes no memory.
class GRAZE_API FeatureFilter {
 public:
  /// A null pointer stands for a mesh whose faces are all in group 0.
  FeatureFilter(const FaceGroups* a, const FaceGroups* b);

  /// Whether any two faces that there are may be tested.
  [[nodiscard]] bool leaves_some() const { return leaves_some_; }
  /// Whether all faces that there are may be tested.
  [[nodiscard]] bool leaves_all() const { return leaves_all_; }

  /// Whether a feature of a and one of b may be tested.
  [[nodiscard]] bool may(const FeatureRef& a, const FeatureRef& b) const {
    return may_sets(set_of(*a_, a), set_of(*b_, b));
  }
  [[nodiscard]] bool may_vertices(std::uint32_t a, std::uint32_t b) const {
    return may_sets(a_->of_vertex(a), b_->of_vertex(b));
  }
  /// Whether a vertex of a, or of b, may be tested against any feature of the other surface.
  [[nodiscard]] bool may_vertex_of_a(std::uint32_t vertex) const {
    return may_sets(a_->of_vertex(vertex), b_->of_region(0));
  }
  [[nodiscard]] bool may_vertex_of_b(std::uint32_t vertex) const {
    return may_sets(a_->of_region(0), b_->of_vertex(vertex));
  }
  /// Whether any features that the two regions own may be tested.
  [[nodiscard]] bool may_regions(const RegionPair& regions) const {
    return may_sets(a_->of_region(regions.a), b_->of_region(regions.b));
  }
  /// A face of a and one of b that may be tested. `leaves_some` holds.
  [[nodiscard]] const std::array<std::uint32_t, 2>& some_faces() const { return some_faces_; }

  // The groups of the faces of a and of b.
  [[nodiscard]] const FaceGroups& of_a() const { return *a_; }
  [[nodiscard]] const FaceGroups& of_b() const { return *b_; }

 protected:
  const FaceGroups* a_;
  const FaceGroups* b_;
  const GroupSet* partners_;  ///< for each set of a: the groups of b that one of its groups may meet
  std::array<std::uint32_t, 2> some_faces_{};
  bool leaves_some_ = true;
  bool leaves_all_ = true;

 private:
  static std::uint32_t set_of(const FaceGroups& groups, const FeatureRef& feature) {
    if (feature.kind == FeatureRefKind::vertex) return groups.of_vertex(feature.index);
    return feature.kind == FeatureRefKind::edge ? groups.of_edge(feature.index)
                                                : groups.of_face(feature.index);
  }
  [[nodiscard]] bool may_sets(std::uint32_t a, std::uint32_t b) const {
    return (partners_[a] & b_->sets()[b]).any();
  }
};

/// A FeatureFilter that ignores groups, and keeps the groups of both meshes. One thread changes it, while
/// none reads it.
class GRAZE_API GroupFilter : public FeatureFilter {
 public:
  /// Ignores nothing yet. A null pointer stands for a mesh whose faces are all in group 0.
  GroupFilter(std::shared_ptr<const FaceGroups> a, std::shared_ptr<const FaceGroups> b);
  GroupFilter(const GroupFilter&) = delete;
  GroupFilter(GroupFilter&&) noexcept = default;
  GroupFilter& operator=(const GroupFilter&) = delete;
  GroupFilter& operator=(GroupFilter&&) noexcept = default;
  ~GroupFilter() = default;

  /// Gives the faces of a or of b other groups, as those of another mesh. What is ignored stays. A null
  /// pointer means what it means to the constructor.
  void set_groups_of_a(std::shared_ptr<const FaceGroups> groups);
  void set_groups_of_b(std::shared_ptr<const FaceGroups> groups);
  /// Sets whether faces of `group_a` of a are ignored against those of `group_b` of b. Takes no memory.
  void set_ignored(std::uint8_t group_a, std::uint8_t group_b, bool ignored);
  /// Calls `visit(group_a, group_b)` with all groups that are ignored, ascending.
  template <typename Visit>
  void visit_ignored(const Visit& visit) const {
    for (std::size_t a = 0; a < looked_at_.size(); ++a)
      for (std::size_t b = 0; b < looked_at_[a].size(); ++b)
        if (!looked_at_[a].test(b)) visit(static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b));
  }

  /// Bytes held, without the groups of the faces.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void find_all();
  void find_partners();
  void find_some_faces();

  std::shared_ptr<const FaceGroups> kept_a_;
  std::shared_ptr<const FaceGroups> kept_b_;
  std::vector<GroupSet> looked_at_;  ///< for each group of a: the groups of b that are not ignored
  std::vector<GroupSet> partners_of_sets_;
};

}  // namespace graze
