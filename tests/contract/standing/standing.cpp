// A program outside the project, built against the installed package: what rigid bodies need to stand on each
// other, and to leave each other where they are in each other.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <graze/graze.hpp>
#include <limits>
#include <memory>
#include <vector>

namespace {

using Eigen::Vector3d;

void expect(bool holds, const char* what) {
  if (!holds) {
    std::fprintf(stderr, "standing: %s\n", what);
    std::exit(1);
  }
}

/// A closed box of 12 triangles, wound outwards.
std::shared_ptr<const graze::Mesh> box_mesh(const Vector3d& half) {
  std::vector<Vector3d> corners;
  for (const double z : {-half.z(), half.z()})
    for (const double y : {-half.y(), half.y()})
      for (const double x : {-half.x(), half.x()}) corners.emplace_back(x, y, z);
  const std::vector<std::array<int, 3>> triangles{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                                  {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                                  {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(corners, triangles));
}

Eigen::Isometry3d pose_of(const Vector3d& at, double yaw, double tilt) {
  const Eigen::AngleAxisd turned(yaw, Vector3d::UnitZ());
  return Eigen::Translation3d(at) * Eigen::AngleAxisd(tilt, Vector3d(0.8, -0.6, 0)) * turned;
}

graze::ObjectSettings rigid_solid() {
  graze::ObjectSettings settings;
  settings.motion = graze::Motion::rigid;
  settings.solid = true;
  return settings;
}

/// A box that lies still about the origin, and another one.
class TwoBoxes {
 public:
  TwoBoxes(const graze::SceneSettings& settings, const Vector3d& half_below, const Vector3d& half_above)
      : scene_(settings), half_below_(half_below), half_above_(half_above) {
    scene_.add(box_mesh(half_below), rigid_solid());
    above_ = scene_.add(box_mesh(half_above), rigid_solid());
  }

  /// Puts the second box over the first with a gap between their faces, turned and tilted.
  graze::ReportHandle step_with_gap(double gap, double yaw, double tilt) {
    return step_at(pose_of({0, 0, half_below_.z() + gap + half_above_.z()}, yaw, tilt));
  }
  graze::ReportHandle step_at(const Eigen::Isometry3d& pose) {
    scene_.set_pose(above_, pose);
    return scene_.step();
  }

 private:
  graze::Scene scene_;
  Vector3d half_below_, half_above_;
  graze::ObjectId above_;
};

graze::SceneSettings nearest_settings(double contact_distance) {
  graze::SceneSettings settings;
  settings.contact_distance = contact_distance;
  settings.detail = graze::ContactDetail::nearest;
  return settings;
}

/// The contacts that push the upper box up.
std::vector<graze::Contact> upright_contacts(const graze::FrameReport& report, graze::ContactKind kind) {
  std::vector<graze::Contact> found;
  for (const graze::Contact& contact : report.contacts())
    if (contact.kind == kind && contact.push().z() > 0.95) found.push_back(contact);
  return found;
}

void outlines_that_cross() {
  struct Placement {
    Vector3d half;
    double yaw;
    std::size_t crossings;  // of the outlines of the two faces that meet
  };
  // Two equal squares, turned by any angle, cross in an octagon. A plank across a plank crosses in a
  // parallelogram.
  const Placement placements[] = {{{0.25, 0.25, 0.25}, 0.047, 8},
                                  {{0.25, 0.25, 0.25}, 0.785, 8},
                                  {{0.25, 0.25, 0.25}, 0.4, 8},
                                  {{0.6, 0.12, 0.05}, 1.5, 4},
                                  {{0.6, 0.12, 0.05}, -1.1, 4}};
  for (const Placement& placement : placements) {
    TwoBoxes boxes(nearest_settings(0.02), placement.half, placement.half);
    for (const double gap : {0.005, 0.001, -0.001, -0.005, -0.01})
      for (const double tilt : {0.0, 1e-9, 1e-6, -1e-6, 1e-4, 1e-3}) {
        const graze::ReportHandle report = boxes.step_with_gap(gap, placement.yaw, tilt);
        const auto corners = upright_contacts(*report, graze::ContactKind::EE);
        expect(corners.size() == placement.crossings, "every corner of the patch is a contact");
        const double lean = 0.7 * std::abs(tilt) + 1e-12;  // how far a tilt lifts or lowers a corner
        for (const graze::Contact& corner : corners) {
          expect(std::abs(corner.separation() - gap) <= lean, "its separation is the gap");
          expect(corner.sunk == (corner.separation() < 0), "it is sunk where the separation is negative");
          expect(!corner.sunk || (corner.side_a == graze::Side::back && corner.side_b == graze::Side::back),
                 "what is sunk lies behind both surfaces");
          expect(corner.push().z() > 0.999, "it pushes up");
        }
      }
  }
}

void patch_is_convex() {
  // The corners lie around the middle of the patch, so that their pushes can carry a weight anywhere over it.
  TwoBoxes boxes(nearest_settings(0.02), {0.25, 0.25, 0.25}, {0.25, 0.25, 0.25});
  for (const double gap : {0.004, -0.004}) {
    const graze::ReportHandle report = boxes.step_with_gap(gap, 0.785, 1e-6);
    for (int direction = 0; direction < 16; ++direction) {
      const Vector3d way(std::cos(direction * 0.3927), std::sin(direction * 0.3927), 0);
      double furthest = -1;
      for (const graze::Contact& corner : upright_contacts(*report, graze::ContactKind::EE))
        furthest = std::max(furthest, corner.point_a.dot(way));
      expect(furthest > 0.22, "there is a corner on each side");
    }
  }
}

void features_agree() {
  graze::SceneSettings settings = nearest_settings(0.02);
  TwoBoxes nearest(settings, {0.6, 0.12, 0.05}, {0.6, 0.12, 0.05});
  settings.detail = graze::ContactDetail::features;
  TwoBoxes features(settings, {0.6, 0.12, 0.05}, {0.6, 0.12, 0.05});
  const graze::ReportHandle some = nearest.step_with_gap(-0.008, 1.5, 1e-6);
  const graze::ReportHandle all = features.step_with_gap(-0.008, 1.5, 1e-6);
  for (const graze::Contact& contact : some->contacts()) {
    if (contact.kind != graze::ContactKind::EE) continue;
    const auto same = std::find_if(all->contacts().begin(), all->contacts().end(), [&](const auto& other) {
      return other.kind == contact.kind && other.feature_a == contact.feature_a &&
             other.feature_b == contact.feature_b;
    });
    expect(same != all->contacts().end(), "`features` lists each pair of edges of `nearest`");
    expect(same->sunk == contact.sunk && same->separation() == contact.separation(),
           "and says the same of it");
  }
}

void plates_that_lie_on_each_other() {
  TwoBoxes plates(nearest_settings(0.05), {0.4, 0.2, 0.005}, {0.4, 0.2, 0.005});
  for (const double yaw : {1.3, 0.7, 0.05})
    for (const double tilt : {0.0, 1e-6}) {
      const graze::ReportHandle report = plates.step_with_gap(0.005, yaw, tilt);
      expect(!report->contacts().empty(), "plates 5 mm apart are in contact");
      for (const graze::Contact& contact : report->contacts())
        expect(contact.separation() > 0 && !contact.sunk, "nothing is deep where nothing pierces");
    }
}

void deepest_contacts_are_kept() {
  const Eigen::Isometry3d tipped(Eigen::Translation3d(0.1, 0.2, 0.93) *
                                 Eigen::AngleAxisd(0.15, Vector3d(1, 0.8, 0).normalized()));
  const auto step = [&](std::size_t limit) {
    graze::SceneSettings settings = nearest_settings(0.02);
    if (limit > 0) settings.max_contacts_per_pair = limit;
    TwoBoxes boxes(settings, {2, 2, 0.5}, {0.5, 0.5, 0.5});
    return boxes.step_at(tipped);
  };
  const graze::ReportHandle all = step(0);
  std::vector<double> separations;
  bool has_piercing = false;
  for (const graze::Contact& contact : all->contacts()) {
    has_piercing = has_piercing || contact.kind == graze::ContactKind::EF;
    if (contact.kind != graze::ContactKind::EF) separations.push_back(contact.separation());
  }
  std::sort(separations.begin(), separations.end());
  expect(has_piercing && separations.size() >= 3 && separations[2] < -0.05,
         "three corners are deep in the ground");
  for (std::size_t limit = 1; limit <= 3; ++limit) {
    const graze::ReportHandle some = step(limit);
    expect(some->contacts().size() == limit, "no more contacts than the limit");
    std::vector<double> kept;
    for (const graze::Contact& contact : some->contacts()) kept.push_back(contact.separation());
    std::sort(kept.begin(), kept.end());
    for (std::size_t i = 0; i < limit; ++i)
      expect(kept[i] == separations[i], "the deepest are kept, and edges that pierce come last");
  }
}

void ways_out() {
  graze::SceneSettings settings = nearest_settings(0.01);
  {
    TwoBoxes planks(settings, {0.6, 0.12, 0.05}, {0.6, 0.12, 0.05});
    const graze::ReportHandle report = planks.step_with_gap(-0.01, 1.5, 0);
    const graze::WayOut& way = report->pairs()[0].way_out;
    expect(way.direction == Vector3d::Zero() && way.extent == 0, "nobody asked for a way out");
  }
  settings.ways_out = true;
  for (const double depth : {0.01, 0.003}) {
    TwoBoxes planks(settings, {0.6, 0.12, 0.05}, {0.6, 0.12, 0.05});
    const graze::ReportHandle report = planks.step_with_gap(-depth, 1.5, 0);
    const graze::WayOut& way = report->pairs()[0].way_out;
    expect((way.direction - Vector3d::UnitZ()).norm() < 1e-9, "the upper plank leaves upwards");
    expect(std::abs(way.thickness - depth) < 1e-9, "it is as deep as it was put");
    expect(way.extent >= depth - 1e-9, "it has at least so far to go");
    expect(way.fullness > 0.5 && way.fullness <= 1 + 1e-12, "the contour winds one way");
    expect(way.point.head<2>().norm() < 1e-9, "the contour is around the middle");
    // By the extent they are apart for certain.
    const graze::ReportHandle apart = planks.step_with_gap(way.extent - depth + 1e-9, 1.5, 0);
    for (const graze::Contact& contact : apart->contacts())
      expect(contact.kind != graze::ContactKind::EF && contact.separation() >= 0,
             "they have left each other");
    expect(apart->pairs().empty() || apart->pairs()[0].way_out.direction == Vector3d::Zero(),
           "no way out where nothing crosses");
  }
  TwoBoxes stake(settings, {0.6, 0.12, 0.05}, {0.02, 0.02, 0.5});
  const graze::ReportHandle through = stake.step_at(pose_of({0.05, 0.03, 0.1}, 0, 0));
  expect(through->pairs()[0].inside == graze::Inside::crossing, "the stake goes through the plank");
  expect(
      through->pairs()[0].way_out.fullness < 0.1 && through->pairs()[0].way_out.direction == Vector3d::Zero(),
      "no direction where the contour cancels");
}

}  // namespace

int main() {
  outlines_that_cross();
  patch_is_convex();
  features_agree();
  plates_that_lie_on_each_other();
  deepest_contacts_are_kept();
  ways_out();
  std::puts("standing: all as agreed");
  return 0;
}
