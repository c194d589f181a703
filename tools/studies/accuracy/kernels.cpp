#include "accuracy/kernels.hpp"

#include <limits>
#include <memory>
#include <vector>

#include "accuracy/contact_error.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/pair_detector.hpp"
#include "core/surface/surface.hpp"
#include "support/oracle/oracle_parallel.hpp"

namespace graze::tools {
namespace {

using oracle::ExactContact;
using oracle::ExactContacts;
using oracle::Name;

Surface surface_of(const oracle::Shape& shape) {
  std::vector<std::uint32_t> corners, counts;
  for (const auto& face : shape.faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    counts.push_back(static_cast<std::uint32_t>(face.size()));
  }
  Surface surface(std::make_shared<const Mesh>(Mesh::from_polygons(shape.positions, corners, counts)));
  surface.refit_vertices();
  surface.refit(RefitOf::radii);
  surface.refit_faces();
  surface.make_blocks();
  return surface;
}

Name name_of(const Contact& contact) {
  return {contact.kind, contact.feature_a, contact.feature_b};
}

Kernel vertex_face_kernel(const oracle::ExactShape& shape, std::uint32_t face) {
  const auto& triangles = shape.faces[face].triangles;
  if (triangles.size() == 1) return Kernel::vertex_triangle;
  const bool is_flat = is_zero(cross(triangles[0].normal, triangles[1].normal));
  return is_flat ? Kernel::vertex_flat_quad : Kernel::vertex_warped_quad;
}

Kernel kernel_of(const Name& name, bool pierced, const ContactMeter& meter) {
  switch (name.kind) {
    case ContactKind::VV:
      return Kernel::vertex_vertex;
    case ContactKind::VE:
      return Kernel::vertex_edge;
    case ContactKind::VF:
      return name.a.kind == FeatureKind::face ? vertex_face_kernel(meter.a(), name.a.index)
                                              : vertex_face_kernel(meter.b(), name.b.index);
    case ContactKind::EE:
      return Kernel::edge_edge;
    case ContactKind::EF:
      return pierced ? Kernel::edge_through_face : Kernel::fold;
    default:
      return Kernel::fold;
  }
}

Kernel parallel_kernel(ContactKind kind) {
  if (kind == ContactKind::EE) return Kernel::parallel_edges;
  return kind == ContactKind::EF ? Kernel::edge_along_face : Kernel::parallel_faces;
}

/// One scene: its two surfaces as the library and as exact arithmetic have them.
class SceneStudy {
 public:
  SceneStudy(const KernelScene& scene, KernelStudy& study)
      : scene_(scene),
        study_(study),
        surface_a_(surface_of(scene.a)),
        surface_b_(surface_of(scene.b)),
        meter_(scene.a, scene.b) {}

  void compare_features() {
    const ExactContacts truth =
        oracle::collect_features(meter_.a(), meter_.b(), oracle::Limit::below(scene_.threshold));
    const PairAnswer answer = detect(ContactDetail::features);
    match(answer.contacts, truth,
          [&](const Name& name, bool pierced) { return kernel_of(name, pierced, meter_); });
    check_bounds(answer, oracle::surface_distance(scene_.a, scene_.b));
  }

  /// Contacts that `features` gives too are only checked by name.
  void compare_closest() {
    const auto truth = oracle::closest(scene_.a, scene_.b, scene_.threshold);
    const PairAnswer answer = detect(ContactDetail::closest);
    if (answer.contacts.size() != (truth ? 1U : 0U)) {
      ++study_.of(Kernel::parallel_faces).wrong_names;
      return;
    }
    if (!truth) return;
    const Name name{truth->kind, truth->a, truth->b};
    const ExactContacts parallel = oracle::collect_parallel(meter_.a(), meter_.b(), truth->distance_squared);
    const auto found = parallel.find(name);
    KernelErrors& errors = study_.of(found == parallel.end() ? kernel_of(name, truth->pierced, meter_)
                                                             : parallel_kernel(name.kind));
    if (name_of(answer.contacts[0]) != name) {
      ++errors.wrong_names;
    } else if (found != parallel.end()) {
      meter_.add(answer.contacts[0], found->second, errors);
    }
  }

  void compare_vertices() {
    ExactContacts truth;
    for (const oracle::Named& named : oracle::vertices(scene_.a, scene_.b, scene_.threshold))
      truth.emplace(Name{named.kind, named.a, named.b},
                    ExactContact{named.distance_squared, oracle::exact(named.point_a),
                                 oracle::exact(named.point_b), false});
    const PairAnswer answer = detect(ContactDetail::vertices);
    match(answer.contacts, truth, [](const Name&, bool) { return Kernel::vertex_set; });
    check_bounds(answer, oracle::vertex_distance(scene_.a, scene_.b));
  }

 private:
  PairAnswer detect(ContactDetail detail) {
    PairQuery query;
    query.detail = detail;
    query.threshold = scene_.threshold;
    query.reach = std::numeric_limits<double>::infinity();
    PairDetector detector;
    PairAnswer answer;
    detector.detect(surface_a_, surface_b_, query, answer, study_.counters);
    return answer;
  }

  /// Walks both sorted lists at once.
  template <typename KernelOf>
  void match(const std::vector<Contact>& contacts, const ExactContacts& truth, const KernelOf& kernel) {
    auto contact = contacts.begin();
    auto expected = truth.begin();
    while (contact != contacts.end() || expected != truth.end()) {
      const bool is_extra =
          expected == truth.end() || (contact != contacts.end() && name_of(*contact) < expected->first);
      const bool is_missing = !is_extra && (contact == contacts.end() || expected->first < name_of(*contact));
      const Name& name = is_extra ? name_of(*contact) : expected->first;
      KernelErrors& errors = study_.of(kernel(name, !is_extra && expected->second.pierced));
      if (is_extra || is_missing) ++errors.wrong_names;
      if (!is_extra && !is_missing) meter_.add(*contact, expected->second, errors);
      if (!is_missing) ++contact;
      if (!is_extra) ++expected;
    }
  }

  void check_bounds(const PairAnswer& answer, const oracle::Pair& truth) {
    ++study_.pair_rows;
    if (answer.distance.lower != truth.distance_down || answer.distance.upper != truth.distance_up)
      ++study_.wrong_pair_rows;
  }

  const KernelScene& scene_;
  KernelStudy& study_;
  Surface surface_a_, surface_b_;
  ContactMeter meter_;
};

}  // namespace

std::string_view name_of(Kernel kernel) {
  static constexpr std::array<std::string_view, kernel_count> names = {
      "vertex-vertex",      "vertex-edge",     "vertex-triangle",   "vertex-flat quad",
      "vertex-warped quad", "edge-edge",       "edge through face", "fold of a quad",
      "vertex sets",        "edge along edge", "edge along face",   "face over face"};
  return names[static_cast<std::size_t>(kernel)];
}

void KernelStudy::add(const KernelScene& scene) {
  ++scenes;
  SceneStudy study(scene, *this);
  study.compare_features();
  study.compare_closest();
  study.compare_vertices();
}

}  // namespace graze::tools
