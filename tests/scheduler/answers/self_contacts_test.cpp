// Contacts of a surface with itself in a scene. The tests are about their age, limits, other meshes, other
// motions, the end of a pair, and contacts at other positions.

#include <algorithm>
#include <cstdint>
#include <graze/contact_geometry.hpp>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/comparison.hpp"
#include "support/details.hpp"
#include "support/oracle/self_pairs.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Random;
using oracle::Shape;

constexpr double distance_of_folds = 0.25;
constexpr double range_of_folds = 2;

using ContactKey = std::tuple<ContactKind, Feature, Feature>;

ContactKey key_of(const Contact& contact) {
  return {contact.kind, contact.feature_a, contact.feature_b};
}

ObjectSettings self_settings(Motion motion = Motion::deformable) {
  ObjectSettings settings;
  settings.motion = motion;
  settings.self = true;
  return settings;
}

/// A strip of 6 by 2 cells of two triangles, flat.
Shape strip_at_rest() {
  Shape shape;
  for (std::uint32_t row = 0; row <= 2; ++row)
    for (std::uint32_t column = 0; column <= 6; ++column) shape.positions.emplace_back(column, row, 0);
  for (std::uint32_t row = 0; row < 2; ++row)
    for (std::uint32_t column = 0; column < 6; ++column) {
      const std::uint32_t corner = row * 7 + column;
      shape.faces.push_back({corner, corner + 1, corner + 8});
      shape.faces.push_back({corner, corner + 8, corner + 7});
    }
  return shape;
}

/// The strip folded in the middle. The upper half lies over the lower one, uneven, at some `gap`.
Shape folded_strip(Random& random, double gap) {
  Shape shape = strip_at_rest();
  for (Eigen::Vector3d& position : shape.positions) {
    if (position.x() > 3) position = {6.25 - position.x(), position.y() + 0.125, gap};
    position += random.vector(-0.05, 0.05);
  }
  return shape;
}

/// The answer of brute force for a strip with itself, with one ring of neighbours.
Expected expected_of_strip(const Shape& now, const Shape& rest, ContactDetail detail, bool self_at_rest) {
  const oracle::SelfPairs self(rest, 1, self_at_rest ? 0 : distance_of_folds);
  Expected expected = expected_of(now, now, distance_of_folds, detail, rest, rest, self.pairs());
  expected.contacts = oracle::each_once(expected.contacts);
  return expected;
}

/// A scene of one strip.
struct StripScene {
  explicit StripScene(const SceneSettings& settings)
      : scene(settings), strip(scene.add(mesh_of(strip_at_rest()), self_settings())) {}

  ReportHandle step_at(const Shape& shape) {
    scene.set_positions(strip, shape.positions);
    return scene.step();
  }

  Scene scene;
  ObjectId strip;
};

SceneSettings strip_settings(ContactDetail detail = ContactDetail::features) {
  return settings_of(distance_of_folds, range_of_folds, detail);
}

}  // namespace

TEST_CASE("self contacts: they age while they last, and begin anew") {
  for (const ContactDetail detail : {ContactDetail::features, ContactDetail::nearest}) {
    CAPTURE(name_of(detail));
    Random random(1);
    StripScene scene(strip_settings(detail));
    std::map<ContactKey, std::uint64_t> ages;
    std::uint64_t oldest = 0;
    std::size_t ended = 0;
    for (int step = 0; step < 30; ++step) {
      const double gap = step % 10 == 9 ? 0.6 : random.between(0.15, 0.2);
      const ReportHandle report = scene.step_at(folded_strip(random, gap));
      std::map<ContactKey, std::uint64_t> now;
      for (const Contact& contact : report->contacts()) {
        const auto before = ages.find(key_of(contact));
        now[key_of(contact)] = before == ages.end() ? 0 : before->second + 1;
        CHECK(report->age(contact) == now[key_of(contact)]);
        oldest = std::max(oldest, report->age(contact));
      }
      for (const auto& [key, age] : ages) ended += now.contains(key) ? 0U : 1U;
      ages.swap(now);
    }
    CHECK(oldest > 2);
    CHECK(ended > 10);
  }
}

TEST_CASE("self contacts: they last when the mesh is replaced, by the vertices that survive") {
  Random random(2);
  const Shape before = folded_strip(random, 0.2);
  StripScene scene(strip_settings());
  (void)scene.step_at(before);
  const ReportHandle first = scene.step_at(before);
  REQUIRE(first->contacts().size() > 10);
  // Vertices are numbered from the other end, and the last two faces are gone.
  const auto last = static_cast<std::uint32_t>(before.positions.size() - 1);
  Shape rest = strip_at_rest();
  Shape after = before;
  std::vector<std::uint32_t> new_of_old;
  for (std::uint32_t vertex = 0; vertex <= last; ++vertex) new_of_old.push_back(last - vertex);
  for (Shape* const shape : {&rest, &after}) {
    std::reverse(shape->positions.begin(), shape->positions.end());
    shape->faces.resize(shape->faces.size() - 2);
    for (auto& face : shape->faces)
      for (std::uint32_t& corner : face) corner = last - corner;
  }
  scene.scene.replace_mesh(scene.strip, mesh_of(rest), new_of_old);
  const ReportHandle report = scene.step_at(after);
  const PairReport& row = only_pair(*report);
  CHECK(row.phase == PairPhase::touching);
  const Expected expected = expected_of_strip(after, rest, ContactDetail::features, false);
  CHECK(difference_of(report->contacts(row), expected.contacts, Tolerance(after, after)) == "");
  CHECK(difference_of(row.distance, row.witness, expected.distance, Tolerance(after, after)) == "");
  // Nothing has moved, so what is listed without the faces that went was listed before, or was hidden by
  // something that went.
  std::size_t lasted = 0;
  for (const Contact& contact : report->contacts()) {
    CHECK((report->age(contact) == 2 || report->age(contact) == 0));
    lasted += report->age(contact) == 2 ? 1U : 0U;
  }
  CHECK(lasted > 10);
}

TEST_CASE("self contacts: a rigid and a fixed object touch themselves as a deformable one does") {
  Random random(3);
  const Shape rest = folded_strip(random, 0.2);
  const Eigen::Vector3d way(8, -4, 2);
  Shape moved_shape = rest;
  for (Eigen::Vector3d& position : moved_shape.positions) position += way;
  const Expected expected = expected_of_strip(moved_shape, rest, ContactDetail::features, true);
  REQUIRE(expected.contacts.size() > 10);
  std::vector<std::string> rows;
  for (const Motion motion : {Motion::deformable, Motion::rigid, Motion::fixed}) {
    CAPTURE(static_cast<int>(motion));
    Scene scene(strip_settings());
    ObjectSettings settings = self_settings(motion);
    const ObjectId without = scene.add(mesh_of(rest), settings);  // what is that near at rest is not tested
    settings.self_at_rest = true;
    const ObjectId strip = scene.add(mesh_of(rest), settings);
    scene.ignore(without, strip);
    const auto place = [&](ObjectId id) {
      if (motion == Motion::deformable) return scene.set_positions(id, moved_shape.positions);
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() = way;
      scene.set_pose(id, pose);
    };
    place(without);
    place(strip);
    const ReportHandle report = scene.step();
    const PairReport* const quiet = find_pair(*report, without, without);
    CHECK((quiet == nullptr || quiet->phase == PairPhase::near));
    const PairReport* const row = find_pair(*report, strip, strip);
    REQUIRE(row != nullptr);
    CHECK(row->phase == PairPhase::began);
    CHECK(difference_of(report->contacts(*row), expected.contacts, Tolerance(moved_shape, moved_shape)) ==
          "");
    rows.push_back(text_of(*report, *row));
    CHECK(rows.back() == rows.front());
    const ReportHandle again = scene.step();
    CHECK(find_pair(*again, strip, strip)->phase == PairPhase::touching);
    CHECK(again->age(again->contacts()[0]) == 1);
  }
}

TEST_CASE("self contacts: limits keep the nearest ones") {
  Random random(4);
  for (int step = 0; step < 10; ++step) {
    const Shape shape = folded_strip(random, random.between(0.05, 0.2));
    StripScene unlimited(strip_settings());
    const ReportHandle all = unlimited.step_at(shape);
    std::vector<Contact> nearest(all->contacts().begin(), all->contacts().end());
    std::sort(nearest.begin(), nearest.end(), [](const Contact& left, const Contact& right) {
      return std::tuple(left.distance, key_of(left)) < std::tuple(right.distance, key_of(right));
    });
    for (const bool of_pair : {false, true}) {
      SceneSettings settings = strip_settings();
      (of_pair ? settings.max_contacts_per_pair : settings.max_contacts) = 7;
      StripScene limited(settings);
      const ReportHandle some = limited.step_at(shape);
      const PairReport& row = only_pair(*some);
      CHECK(row.contacts_cut);
      CHECK_FALSE(row.complete);
      REQUIRE(some->contacts().size() == 7);
      std::vector<ContactKey> expected;
      for (std::size_t i = 0; i < 7; ++i) expected.push_back(key_of(nearest.at(i)));
      std::sort(expected.begin(), expected.end());
      for (std::size_t i = 0; i < 7; ++i) CHECK(key_of(some->contacts()[i]) == expected[i]);
      const PairReport& whole = only_pair(*all);
      CHECK((row.distance.lower == whole.distance.lower && row.distance.upper == whole.distance.upper));
      CHECK((row.witness.point_a == whole.witness.point_a && row.witness.point_b == whole.witness.point_b));
    }
  }
}

TEST_CASE("self contacts: a pair that was in contact ends once when its object is removed") {
  Random random(5);
  StripScene scene(strip_settings());
  const ObjectId plate = scene.scene.add(plate_mesh());
  scene.scene.set_positions(plate, lifted(*plate_mesh(), 50));
  const ReportHandle before = scene.step_at(folded_strip(random, 0.2));
  REQUIRE(only_pair(*before).phase == PairPhase::began);
  CHECK(before->statistics().pairs_total == 2);
  scene.scene.remove(scene.strip);
  const ReportHandle report = scene.scene.step();
  const PairReport& row = only_pair(*report);
  CHECK((row.a == scene.strip && row.b == scene.strip));
  CHECK(row.phase == PairPhase::ended);
  CHECK(row.contact_count == 0);
  CHECK(row.distance.upper == only_pair(*before).distance.upper);
  CHECK(report->statistics().pairs_total == 0);
  CHECK(scene.scene.step()->pairs().empty());
}

TEST_CASE("self contacts: evaluate says where they are when the surface has moved") {
  Random random(6);
  std::size_t compared = 0;
  for (int step = 0; step < 10; ++step) {
    const Shape before = folded_strip(random, 0.18);
    Shape after = before;
    for (Eigen::Vector3d& position : after.positions) position += random.vector(-0.01, 0.01);
    StripScene scene(strip_settings());
    const auto mesh = scene.scene.mesh(scene.strip);
    const ReportHandle report = scene.step_at(before);
    std::map<ContactKey, Contact> moved_contacts;
    const ReportHandle later = scene.step_at(after);
    for (const Contact& contact : later->contacts()) moved_contacts[key_of(contact)] = contact;
    for (const Contact& contact : report->contacts()) {
      const ContactGeometry same = evaluate(*mesh, before.positions, *mesh, before.positions, contact);
      CHECK(std::abs(same.separation - contact.separation()) < 1e-12);
      CHECK((same.side_a == contact.side_a && same.side_b == contact.side_b));
      const auto found = moved_contacts.find(key_of(contact));
      if (found == moved_contacts.end() || contact.distance == 0) continue;
      ++compared;
      const Contact& expected = found->second;
      const ContactGeometry now = evaluate(*mesh, after.positions, *mesh, after.positions, contact);
      CHECK(std::abs(now.distance - expected.distance) < 1e-12);
      CHECK((now.point_a - expected.point_a).norm() < 1e-9);
      CHECK((now.point_b - expected.point_b).norm() < 1e-9);
    }
  }
  CHECK(compared > 50);
}

}  // namespace graze::tests
