// A program outside the project, built against the installed package: what a response to contacts uses.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <graze/graze.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

namespace {

using Points = std::vector<Eigen::Vector3d>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

void expect(bool holds, const char* what) {
  if (!holds) {
    std::fprintf(stderr, "response: %s\n", what);
    std::exit(1);
  }
}

// A closed cube of 8 vertices and 12 triangles, outward.
Points cube_points(double half, const Eigen::Vector3d& centre) {
  Points points;
  for (int i = 0; i < 8; ++i)
    points.push_back(centre + half * Eigen::Vector3d((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1));
  return points;
}
const Triangles cube_triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

std::shared_ptr<const graze::Mesh> share(graze::Mesh mesh) {
  return std::make_shared<const graze::Mesh>(std::move(mesh));
}

// Two triangles, four by four, in the plane z = 0, facing up; the diagonal runs along x = y.
const Points plate_points = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
const Triangles plate_triangles = {{0, 1, 2}, {0, 2, 3}};

void nearest() {
  const auto plate = share(graze::Mesh::from_triangles(plate_points, plate_triangles));
  const auto cube = share(graze::Mesh::from_triangles(cube_points(0.1, {0.35, 0.1, 0.105}), cube_triangles));
  graze::SceneSettings settings;
  settings.contact_distance = 0.01;
  settings.detail = graze::ContactDetail::nearest;
  graze::Scene scene(settings);
  const graze::ObjectId a = scene.add(plate);
  const graze::ObjectId b = scene.add(cube);
  const graze::ReportHandle report = scene.step(77);
  expect(report->tag() == 77, "a report gives the caller's number back");
  expect(report->pairs().size() == 1 && report->contacts().size() == 4,
         "one contact for each vertex at the bottom");
  for (const graze::Contact& contact : report->contacts()) {
    expect(contact.kind == graze::ContactKind::VF && contact.side_a == graze::Side::front,
           "a vertex over a face");
    expect(std::abs(contact.separation() - 0.005) < 1e-12, "above is a positive separation");
    expect((contact.push() - Eigen::Vector3d(0, 0, 1)).norm() < 1e-9, "up parts them");
    const graze::SurfaceWeights where =
        graze::weights(*plate, graze::PositionView(plate_points), contact.feature_a, contact.point_a);
    expect(where.count == 3, "three corners");
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double sum = 0;
    for (int i = 0; i < where.count; ++i) {
      point += where.weight[std::size_t(i)] * plate_points[where.vertex[std::size_t(i)]];
      sum += where.weight[std::size_t(i)];
    }
    expect(std::abs(sum - 1) < 1e-12 && (point - contact.point_a).norm() < 1e-12, "weights give the point");
    const Points lower = cube_points(0.1, {0.35, 0.1, 0.098});
    const graze::ContactGeometry now =
        graze::evaluate(*plate, graze::PositionView(plate_points), contact.feature_a, *cube,
                        graze::PositionView(lower), contact.feature_b);
    expect(
        std::abs(now.distance - 0.002) < 1e-12 && std::abs(now.separation + 0.002) < 1e-12 && now.is_interior,
        "sunk in by 2 mm at the new positions");
  }
  std::unordered_map<graze::ObjectId, int> by_id = {{a, 1}, {b, 2}};
  expect(by_id.at(report->pairs()[0].b) == 2, "ids can be hashed");
}

void solid() {
  const auto large = share(graze::Mesh::from_triangles(cube_points(1, {0, 0, 0}), cube_triangles));
  const auto small = share(graze::Mesh::from_triangles(cube_points(0.1, {0.1, 0.2, 0.3}), cube_triangles));
  graze::SceneSettings settings;
  settings.contact_distance = 0.01;
  settings.detail = graze::ContactDetail::nearest;
  graze::Scene scene(settings);
  graze::ObjectSettings is_solid;
  is_solid.solid = true;
  scene.add(large, is_solid);
  const graze::ObjectId b = scene.add(small);
  const graze::ReportHandle report = scene.step();
  expect(report->pairs().size() == 1, "what is inside a solid is listed");
  const graze::PairReport& pair = report->pairs()[0];
  expect(pair.inside == graze::Inside::b_in_a && pair.phase == graze::PairPhase::began,
         "wholly inside is in contact");
  expect(std::abs(pair.distance.upper - 0.6) < 1e-12, "the distance is that of the surfaces");
  expect(report->contacts().size() == 8, "each vertex inside has a way out");
  for (const graze::Contact& contact : report->contacts()) {
    expect(
        contact.side_a == graze::Side::back && contact.separation() < -0.59 && contact.separation() > -0.81,
        "inside, by so much");
    expect(contact.push().dot(contact.point_a - contact.point_b) > 0, "towards the surface");
  }
  scene.remove(b);
  const graze::ReportHandle ended = scene.step();
  expect(ended->pairs().size() == 1 && ended->pairs()[0].phase == graze::PairPhase::ended,
         "removed, it ends once");
  bool refused = false;
  try {
    scene.add(share(graze::Mesh::from_triangles(plate_points, plate_triangles)), is_solid);
  } catch (const graze::Error&) {
    refused = true;
  }
  expect(refused, "an open surface is no solid");
}

void replaced_and_grouped() {
  const auto plate = share(graze::Mesh::from_triangles(plate_points, plate_triangles));
  const auto cube = share(graze::Mesh::from_triangles(cube_points(0.1, {0.35, 0.1, 0.105}), cube_triangles));
  graze::SceneSettings settings;
  settings.contact_distance = 0.01;
  settings.detail = graze::ContactDetail::nearest;
  graze::Scene scene(settings);
  graze::ObjectSettings grouped;
  grouped.face_groups = {1, 2};
  const graze::ObjectId a = scene.add(plate, grouped);
  const graze::ObjectId b = scene.add(cube);
  const graze::ReportHandle before = scene.step();
  const std::uint64_t since = before->contacts()[0].since;
  // The same plate with one more face, far from the cube.
  Points points = plate_points;
  points.push_back({5, 0, 0});
  scene.replace_mesh(a, share(graze::Mesh::from_triangles(points, {{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}})),
                     std::vector<std::uint32_t>{0, 1, 2, 3});
  const graze::ReportHandle after = scene.step();
  expect(after->pairs()[0].phase == graze::PairPhase::touching && after->contacts().size() == 4,
         "touching goes on");
  expect(after->contacts()[0].since == since, "and so do the contacts");
  scene.ignore(a, 0, b, 0);
  expect(scene.step()->pairs()[0].phase == graze::PairPhase::ended,
         "a replaced mesh has its faces in group 0, which is ignored");
}

}  // namespace

int main() {
  nearest();
  solid();
  replaced_and_grouped();
  std::puts("response: all as agreed");
  return 0;
}
