#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/export.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/mesh/face_groups.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/pair/near_list.hpp"
#include "core/pair/self_exclusion.hpp"

namespace graze {

/// Says which features of two surfaces may be tested against each other, by the groups of their faces. For a
/// surface and itself, features that belong together are left out as well (SelfQuery).
///
/// Two features may be if some face of the one and some face of the other are not hidden, and in groups that
/// are not ignored. A fold belongs to its quad. So exactly those features are tested that belong to two
/// faces that are. This one ignores no groups. It refers to the groups of both meshes, and takes no memory.
class GRAZE_API FeatureFilter {
 public:
  /// A null pointer stands for a mesh whose faces are all in group 0.
  FeatureFilter(const FaceGroups* a, const FaceGroups* b);
  /// The groups of another filter of a surface and itself, of which features are left out.
  FeatureFilter(const FeatureFilter& groups, const SelfQuery& self) : FeatureFilter(groups) {
    self_ = self;
    leaves_all_ = false;
  }

  /// Whether any two faces that there are may be tested.
  [[nodiscard]] bool leaves_some() const { return leaves_some_; }
  /// Whether all faces that there are may be tested.
  [[nodiscard]] bool leaves_all() const { return leaves_all_; }

  /// Whether this is a query about a surface and itself.
  [[nodiscard]] bool is_of_self() const { return self_.exclusion != nullptr; }
  /// Says what a surface with itself leaves out. It is null for two surfaces.
  [[nodiscard]] const SelfExclusion* self() const { return self_.exclusion; }
  /// Whether the groups of a feature of a and of one of b let them be tested.
  [[nodiscard]] bool may_groups(const FeatureRef& a, const FeatureRef& b) const {
    return may_sets(set_of(*a_, a), set_of(*b_, b));
  }
  /// Whether a feature of a and one of b may be tested. They are a vertex and a face, two edges or folds, or
  /// features that are parallel.
  [[nodiscard]] bool may(const FeatureRef& a, const FeatureRef& b) const {
    return may_groups(a, b) && (!is_of_self() || may_of_self(a, b));
  }
  /// Whether it counts that an edge or fold pierces a face.
  [[nodiscard]] bool may_pierce(const FeatureRef& a, const FeatureRef& b) const {
    return may_groups(a, b) && (!is_of_self() || !self_.exclusion->share_vertex(a, b));
  }
  /// Whether two vertices may be tested, or some features that they are corners of. Two vertices of one
  /// surface are tested in one order only, where pairs are of vertices.
  [[nodiscard]] bool may_vertices(std::uint32_t a, std::uint32_t b) const {
    return may_sets(a_->of_vertex(a), b_->of_vertex(b)) && (!is_of_self() || may_vertices_of_self(a, b));
  }
  /// Whether a vertex of a surface may be tested with a face of the same surface that has a feature, or is
  /// it.
  [[nodiscard]] bool may_vertex(std::uint32_t vertex, const Feature& feature) const;
  /// Two vertices that may be tested, or whose distance bounds one that is: corners of a pair of faces. There
  /// may be none only for a surface and itself.
  [[nodiscard]] std::optional<std::array<std::uint32_t, 2>> some_vertices(const IndexedMesh& mesh_a,
                                                                          const IndexedMesh& mesh_b) const;
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

  // The groups of the faces of a and of b.
  [[nodiscard]] const FaceGroups& of_a() const { return *a_; }
  [[nodiscard]] const FaceGroups& of_b() const { return *b_; }

 protected:
  const FaceGroups* a_;
  const FaceGroups* b_;
  const GroupSet* partners_;  ///< for each set of a: the groups of b that one of its groups may meet
  /// A face of a and one of b that groups let be tested, where there are any.
  std::array<std::uint32_t, 2> some_faces_{};
  SelfQuery self_;
  bool leaves_some_ = true;
  bool leaves_all_ = true;

 private:
  static std::uint32_t set_of(const FaceGroups& groups, const FeatureRef& feature) {
    if (feature.kind == FeatureRefKind::vertex) return groups.of_vertex(feature.index);
    return feature.kind == FeatureRefKind::edge ? groups.of_edge(feature.index)
                                                : groups.of_face(feature.index);
  }
  [[nodiscard]] bool may_of_self(const FeatureRef& a, const FeatureRef& b) const;
  [[nodiscard]] bool may_vertices_of_self(std::uint32_t a, std::uint32_t b) const;
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
