#pragma once

#include <cstdint>
#include <graze/graze.hpp>
#include <memory>
#include <span>
#include <vector>

#include "rigid/contact.hpp"

namespace graze::rigid {

/// Finds contacts by a scene of graze, with ContactDetail::nearest. All objects are solids.
///
/// Edges that pierce are left out, since they do not say how deep they are. So are contacts whose vertices or
/// edges do not bear: see in_normal_cone().
///
/// A pair whose surfaces pass through each other may have no contact that is a quarter as deep as the pair is
/// thick there. It has one other contact in place of all these: in the middle of its contour, along the way
/// out.
class GrazeContacts : public ContactSource {
 public:
  /// Takes the settings of a scene, but for the detail.
  explicit GrazeContacts(SceneSettings settings);

  /// Adds the surface of the next body: the first call is for body 0. A body that nothing pushes is fixed.
  /// The object's name, groups and filters are taken from `object`. Returns its id in the scene.
  ObjectId add(std::shared_ptr<const Mesh> mesh, const Body& body, ObjectSettings object = {});

  void find(std::span<const Body> bodies, std::vector<Contact>& contacts) override;

  [[nodiscard]] Scene& scene() { return scene_; }
  /// Returns what the last search saw.
  [[nodiscard]] const ReportHandle& report() const { return report_; }

 private:
  /// Whether a feature bears along a way in the world. Faces do.
  [[nodiscard]] bool bears(std::uint32_t body, const Feature& feature, const Eigen::Vector3d& way) const;
  void add_contacts(const PairReport& pair, std::vector<Contact>& contacts) const;

  Scene scene_;
  std::vector<ObjectId> ids_;
  std::vector<std::shared_ptr<const Mesh>> meshes_;
  std::vector<Eigen::Matrix3d> rotations_;  ///< of the bodies, as the last search saw them
  ReportHandle report_;
};

}  // namespace graze::rigid
