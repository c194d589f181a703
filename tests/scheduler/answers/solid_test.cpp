// ObjectSettings::solid against brute force: contacts, sides, what lies in what, and phases of random closed
// shapes, at rest and from step to step.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/comparison.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"
#include "support/exact/exact_winding.hpp"
#include "support/random/random_solids.hpp"
#include "support/reduce.hpp"

namespace graze::tests {
namespace {

using oracle::Containment;
using oracle::RandomSolids;
using oracle::Shape;

constexpr std::uint64_t solid_part_count = 10;
#ifdef GRAZE_VALIDATE
constexpr std::uint64_t solid_grid_scenes = 2'500 / solid_part_count;  // each takes ten times as long there
#else
constexpr std::uint64_t solid_grid_scenes = 10'000 / solid_part_count;
#endif
constexpr std::uint64_t solid_generic_scenes = solid_grid_scenes / 5;

ObjectSettings solid_settings(bool is_solid) {
  ObjectSettings settings;
  settings.solid = is_solid;
  return settings;
}

Containment containment_of(Inside inside) {
  switch (inside) {
    case Inside::none:
      return Containment::none;
    case Inside::a_in_b:
      return Containment::a_in_b;
    case Inside::b_in_a:
      return Containment::b_in_a;
    case Inside::crossing:
      return Containment::crossing;
  }
  return Containment::none;
}

std::string name_of(Containment containment) {
  static constexpr std::array names = {"none", "a_in_b", "b_in_a", "crossing"};
  return names[static_cast<std::size_t>(containment)];
}

/// Holds what brute force says of a pair. The scene has to outlive it.
struct SolidTruth {
  explicit SolidTruth(const RandomSolids& scene) : SolidTruth(scene, scene.a, scene.b) {}
  SolidTruth(const RandomSolids& scene, const Shape& rest_a, const Shape& rest_b)
      : solid(oracle::solid_pair(scene.a, scene.b, scene.solids, scene.threshold, rest_a, rest_b)),
        distance(oracle::surface_distance(scene.a, scene.b)),
        tolerance(scene.a, scene.b),
        is_touching_as_surfaces(distance.pierced || is_within(distance, scene.threshold)),
        is_touching(is_touching_as_surfaces || solid.has_vertex_inside) {}

  oracle::SolidPair solid;
  oracle::Pair distance;
  Tolerance tolerance;
  bool is_touching_as_surfaces;
  bool is_touching;
};

/// The sides of contacts that solids decide.
std::string side_difference(std::span<const Contact> contacts, const oracle::SolidPair& expected) {
  std::string text;
  for (std::size_t i = 0; i < std::min(contacts.size(), expected.sides.size()); ++i) {
    const Contact& contact = contacts[i];
    const oracle::SolidSides& sides = expected.sides[i];
    const auto compare = [&](const char* which, Side got, const std::optional<Side>& wanted) {
      if (!wanted || got == *wanted) return;
      text += std::string(which) + " is " + std::string(to_string(got)) + " instead of " +
              std::string(to_string(*wanted)) + ":\n" + text_of(contacts.subspan(i, 1));
    };
    compare("side_a", contact.side_a, sides.a);
    compare("side_b", contact.side_b, sides.b);
  }
  return text;
}

/// How one row, or its absence, differs from brute force in the details that solids leave as they are.
std::string row_difference(const FrameReport& report, const PairReport* row, PairPhase phase,
                           const SolidTruth& truth, double reach) {
  const bool is_listed = truth.is_touching || phase == PairPhase::ended || is_within(truth.distance, reach);
  if ((row != nullptr) != is_listed) return is_listed ? "not listed\n" : "listed\n";
  if (row == nullptr) return {};
  std::string text;
  if (row->phase != phase)
    text += std::string(to_string(row->phase)) + " instead of " + std::string(to_string(phase)) + "\n";
  if (containment_of(row->inside) != truth.solid.inside)
    text += name_of(containment_of(row->inside)) + " instead of " + name_of(truth.solid.inside) + "\n";
  if (!row->complete || row->stale) text += "not complete\n";
  const std::string inconsistency = inconsistency_of(report);
  return text + inconsistency + difference_of(row->distance, row->witness, truth.distance, truth.tolerance);
}

std::string solid_difference(const FrameReport& report, const PairReport* row, PairPhase phase,
                             const SolidTruth& truth, ContactDetail detail, double reach) {
  std::string text = row_difference(report, row, phase, truth, reach);
  if (row == nullptr) return text;
  const auto contacts = report.contacts(*row);
  if (detail == ContactDetail::none && !contacts.empty()) text += "contacts in detail none\n";
  if (detail == ContactDetail::nearest) {
    text += difference_of(contacts, truth.solid.contacts, truth.tolerance);
    if (text.empty()) text += side_difference(contacts, truth.solid);
  }
  return text;
}

PairPhase first_phase(const SolidTruth& truth) {
  return truth.is_touching ? PairPhase::began : PairPhase::near;
}

double range_of(const RandomSolids& scene, std::uint64_t seed) {
  if (seed % 7 == 1) return 0;
  return seed % 3 == 0 ? std::numeric_limits<double>::infinity() : scene.threshold / 2 + 3;
}

/// A scene with two objects.
struct TwoObjects {
  TwoObjects(const RandomSolids& given, ContactDetail detail, double range, unsigned threads = 1,
             bool with_solids = true)
      : scene(settings_with(given, detail, range, threads)),
        a(scene.add(mesh_of(given.a), solid_settings(with_solids && given.solids.a))),
        b(scene.add(mesh_of(given.b), solid_settings(with_solids && given.solids.b))) {}

  static SceneSettings settings_with(const RandomSolids& given, ContactDetail detail, double range,
                                     unsigned threads) {
    SceneSettings settings = settings_of(given.threshold, range, detail);
    settings.threads = threads;
    return settings;
  }
  void set_positions(const RandomSolids& given) {
    scene.set_positions(a, given.a.positions);
    scene.set_positions(b, given.b.positions);
  }
  [[nodiscard]] const PairReport* row(const FrameReport& report) const { return find_pair(report, a, b); }

  Scene scene;
  ObjectId a, b;
};

std::string contact_text(const Contact& contact) {
  std::ostringstream out;
  out << std::hexfloat << contact.distance << " " << contact.point_a.transpose() << " "
      << contact.point_b.transpose() << " " << contact.normal.transpose();
  return out.str();
}

/// The sides and numbers of the contacts by their names, as text. Sides that solids decide are left out.
std::string contact_list_text(std::span<const Contact> contacts, bool with_sides) {
  std::string text;
  for (const Contact& contact : contacts) {
    text += text_of(std::span(&contact, 1)) + "    " + contact_text(contact);
    if (with_sides)
      text += " " + std::string(to_string(contact.side_a)) + " " + std::string(to_string(contact.side_b));
    text += "\n";
  }
  return text;
}

/// Contacts in `closest` and `features`, and all of `nearest` that solids do not add, are those of surfaces.
std::string difference_from_surfaces(const RandomSolids& given, ContactDetail detail, double range,
                                     const FrameReport& with_solids, const PairReport* row) {
  if (row == nullptr) return {};
  TwoObjects plain(given, detail, range, 1, false);
  const ReportHandle report = plain.scene.step();
  const PairReport* plain_row = plain.row(*report);
  const auto expected = plain_row != nullptr ? report->contacts(*plain_row) : std::span<const Contact>();
  const auto contacts = with_solids.contacts(*row);
  if (detail != ContactDetail::nearest) {
    const std::string got = contact_list_text(contacts, true);
    const std::string wanted = contact_list_text(expected, true);
    return got == wanted ? "" : "not the contacts of surfaces:\n" + got + "expected:\n" + wanted;
  }
  const std::string all = contact_list_text(contacts, false);
  for (const Contact& contact : expected) {
    const std::string wanted = contact_list_text(std::span(&contact, 1), false);
    if (all.find(wanted) == std::string::npos) return "without a contact of surfaces:\n" + wanted;
  }
  return {};
}

struct SolidTally {
  std::size_t contacts = 0;
  std::array<std::size_t, 4> containments{};
};

/// How a scene at rest differs from brute force, in detail `nearest` and in one of the other details about
/// surfaces. Every second scene is also compared with one without solids.
std::string solid_fault(const RandomSolids& given, std::uint64_t seed, SolidTally* tally = nullptr) {
  const SolidTruth truth(given);
  const double range = range_of(given, seed);
  std::string text;
  for (const ContactDetail detail : {surface_details[seed / 2 % 3], ContactDetail::nearest}) {
    TwoObjects objects(given, detail, range);
    const ReportHandle report = objects.scene.step();
    const PairReport* row = objects.row(*report);
    std::string difference =
        solid_difference(*report, row, first_phase(truth), truth, detail, std::max(range, given.threshold));
    if (detail != ContactDetail::none && seed / 6 % 2 == 0)
      difference += difference_from_surfaces(given, detail, range, *report, row);
    if (!difference.empty()) text += "detail " + std::string(name_of(detail)) + ": " + difference;
  }
  if (tally != nullptr) {
    tally->contacts += truth.solid.contacts.size();
    ++tally->containments[static_cast<std::size_t>(truth.solid.inside)];
  }
  return text;
}

/// Compares the scene of a seed. One that differs is reduced, as far as solids stay closed.
void check_solids(std::uint64_t seed, SolidTally& tally) {
  const RandomSolids scene = oracle::random_solids(seed);
  const std::string fault = solid_fault(scene, seed, &tally);
  if (fault.empty()) return;
  const Judge judge = [&](const TwoShapes& shapes) -> std::string {
    const RandomSolids smaller{shapes.a, shapes.b, scene.solids, shapes.threshold};
    if (smaller.solids.a && !oracle::is_closed(smaller.a)) return {};
    if (smaller.solids.b && !oracle::is_closed(smaller.b)) return {};
    return solid_fault(smaller, seed);
  };
  FAIL_CHECK("seed " << seed << ", solid: " << scene.solids.a << " " << scene.solids.b << "\n"
                     << fault << "reduced:\n"
                     << reduced_text({scene.a, scene.b, scene.threshold}, judge));
}

PairPhase next_phase(bool was_touching, bool is_touching) {
  if (is_touching) return was_touching ? PairPhase::touching : PairPhase::began;
  return was_touching ? PairPhase::ended : PairPhase::near;
}

/// Plays a scene with motion at 1 and at 2 threads, and compares each step with brute force and with a scene
/// built afresh. Returns how often the phase or what lies in what changed.
std::size_t check_steps(RandomSolids given, std::uint64_t seed, ContactDetail detail) {
  const double range = range_of(given, seed);
  const RandomSolids at_rest = given;
  TwoObjects one(given, detail, range, 1);
  TwoObjects two(given, detail, range, 2);
  oracle::Random random(seed);
  bool was_touching = false;
  Containment was = Containment::none;
  std::size_t changes = 0;
  for (int step = 0; step < 5; ++step) {
    const ReportHandle report = one.scene.step();
    const ReportHandle report_of_two = two.scene.step();
    const SolidTruth truth(given, at_rest.a, at_rest.b);
    const PairPhase phase = next_phase(was_touching, truth.is_touching);
    INFO("seed " << seed << ", step " << step << ", detail " << name_of(detail)
                 << ", solid: " << given.solids.a << " " << given.solids.b << "\n"
                 << text_of(TwoShapes{given.a, given.b, given.threshold}));
    REQUIRE(solid_difference(*report, one.row(*report), phase, truth, detail,
                             std::max(range, given.threshold)) == "");
    REQUIRE(difference_of(*report, *report_of_two) == "");
    TwoObjects afresh(at_rest, detail, range);
    afresh.set_positions(given);
    REQUIRE(timeless_rows_of(*afresh.scene.step(), range) == timeless_rows_of(*report, range));
    changes += (step > 0 && was != truth.solid.inside) || phase == PairPhase::ended ? 1U : 0U;
    was = truth.solid.inside;
    was_touching = truth.is_touching;
    if (random.chance(0.3)) oracle::move_on_grid(given.a, random);
    if (random.chance(0.8)) oracle::move_on_grid(given.b, random);
    for (TwoObjects* objects : {&one, &two}) objects->set_positions(given);
  }
  return changes;
}

/// A closed box of triangles, wound outwards.
Shape oracle_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Shape shape;
  for (unsigned i = 0; i < 8; ++i)
    shape.positions.emplace_back((i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                                 (i & 4U) != 0 ? high.z() : low.z());
  shape.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return shape;
}

/// A triangle that stands on its tip.
Shape pin(const Eigen::Vector3d& tip) {
  return {{tip, tip + Eigen::Vector3d(0.25, 0, 4), tip + Eigen::Vector3d(-0.125, 0.25, 4)}, {{0, 1, 2}}};
}

/// The shape after a quarter turn about z, and moved by whole numbers.
Shape quarter_turned(Shape shape, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& position : shape.positions)
    position = Eigen::Vector3d(-position.y(), position.x(), position.z()) + by;
  return shape;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("solids: 10,000 random scenes are those of brute force, part", "",
                       ((int solid_part), solid_part), 0, 1, 2, 3, 4, 5, 6, 7, 8, 9) {
  SolidTally tally;
  for (std::uint64_t i = 0; i < solid_grid_scenes; ++i)
    check_solids(2 * (solid_part * solid_grid_scenes + i) + 1, tally);
  for (std::uint64_t i = 0; i < solid_generic_scenes; ++i)
    check_solids(2 * (solid_part * solid_generic_scenes + i), tally);
  CHECK(tally.contacts > 5 * solid_grid_scenes);
  for (const std::size_t count : tally.containments) CHECK(count > solid_grid_scenes / 100);
  std::cout << "compared " << solid_grid_scenes + solid_generic_scenes << " scenes with solids, "
            << tally.contacts << " contacts\n";
}

TEST_CASE("solids: steps with motion are those of brute force, at 1 and 2 threads") {
  std::size_t changes = 0;
  for (std::uint64_t seed = 0; seed < 160; ++seed)
    changes += check_steps(oracle::random_solids(2 * seed + 1), seed, surface_details[seed % 4]);
  CHECK(changes > 50);
}

TEST_CASE("solids: rigid objects are inside by their poses") {
  std::size_t inside = 0;
  for (std::uint64_t seed = 1; seed < 200; seed += 2) {
    RandomSolids given = oracle::random_solids(seed);
    INFO("seed " << seed);
    Scene scene(settings_of(given.threshold, 1, ContactDetail::nearest));
    ObjectSettings of_a = solid_settings(given.solids.a);
    ObjectSettings of_b = solid_settings(given.solids.b);
    of_a.motion = of_b.motion = Motion::rigid;
    const ObjectId a = scene.add(mesh_of(given.a), of_a);
    const ObjectId b = scene.add(mesh_of(given.b), of_b);
    scene.step();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    pose.translation() << 4, -4, 8;
    scene.set_pose(a, pose);
    scene.step();
    scene.set_pose(b, pose);
    const ReportHandle report = scene.step();
    given.a = quarter_turned(given.a, pose.translation());
    given.b = quarter_turned(given.b, pose.translation());
    const SolidTruth truth(given);
    const PairReport* row = find_pair(*report, a, b);
    REQUIRE((row != nullptr || !truth.is_touching));
    if (row == nullptr || !truth.is_touching) continue;
    CHECK(containment_of(row->inside) == truth.solid.inside);
    CHECK(difference_of(report->contacts(*row), truth.solid.contacts, truth.tolerance) == "");
    CHECK(side_difference(report->contacts(*row), truth.solid) == "");
    inside += truth.solid.has_vertex_inside ? 1U : 0U;
  }
  CHECK(inside > 20);
}

TEST_CASE("solids: contacts, and what is inside, are exact in AccuracyMode::within too") {
  std::size_t inside = 0;
  for (std::uint64_t seed = 1; seed < repeats(400); seed += 2) {
    const RandomSolids given = oracle::random_solids(seed);
    INFO("seed " << seed);
    SceneSettings settings = settings_of(given.threshold, 3, ContactDetail::nearest);
    settings.accuracy = Accuracy::within(5);
    Scene scene(settings);
    const ObjectId a = scene.add(mesh_of(given.a), solid_settings(given.solids.a));
    const ObjectId b = scene.add(mesh_of(given.b), solid_settings(given.solids.b));
    const ReportHandle report = scene.step();
    const SolidTruth truth(given);
    const PairReport* row = find_pair(*report, a, b);
    REQUIRE((row != nullptr || !truth.is_touching));
    if (row == nullptr) continue;
    REQUIRE(row->phase == first_phase(truth));
    REQUIRE(containment_of(row->inside) == truth.solid.inside);
    REQUIRE(difference_of(report->contacts(*row), truth.solid.contacts, truth.tolerance) == "");
    REQUIRE(side_difference(report->contacts(*row), truth.solid) == "");
    REQUIRE(row->distance.lower <= truth.distance.distance_down);
    REQUIRE(row->distance.upper >= truth.distance.distance_up);
    inside += truth.solid.has_vertex_inside ? 1U : 0U;
  }
  CHECK(inside > repeats(50));
}

TEST_CASE("solids: every pair of six objects is that of brute force") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    std::vector<Shape> shapes;
    std::vector<bool> is_solid;
    for (std::uint64_t i = 0; i < 3; ++i) {
      const RandomSolids given = oracle::random_solids(6 * seed + 2 * i + 1);
      shapes.insert(shapes.end(), {given.a, given.b});
      is_solid.insert(is_solid.end(), {given.solids.a, given.solids.b});
    }
    SceneSettings settings = settings_of(2, 5, ContactDetail::nearest);
    settings.threads = 2;
    Scene scene(settings);
    std::vector<ObjectId> ids;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      ids.push_back(scene.add(mesh_of(shapes[i]), solid_settings(is_solid[i])));
    const ReportHandle report = scene.step();
    for (std::size_t a = 0; a < ids.size(); ++a)
      for (std::size_t b = a + 1; b < ids.size(); ++b) {
        INFO("seed " << seed << ", objects " << a << " and " << b);
        const RandomSolids given{shapes[a], shapes[b], {is_solid[a], is_solid[b]}, 2};
        const SolidTruth truth(given);
        REQUIRE(solid_difference(*report, find_pair(*report, ids[a], ids[b]), first_phase(truth), truth,
                                 ContactDetail::nearest, 5) == "");
      }
  }
}

TEST_CASE("solids: a vertex inside begins in every detail, also where faces are flush, at distance 0") {
  // The block's faces are flush with the small box's, of which one corner is inside. Nothing pierces.
  const Shape block = oracle_box({0, 0, 0}, {1, 1, 1});
  const Shape small = oracle_box({0, 0, 0}, {0.5, 0.25, 0.625});
  for (const ContactDetail detail : surface_details)
    for (const double range : {0.0, 1.0}) {
      TwoObjects objects({block, small, {true, false}, 0}, detail, range);
      for (const PairPhase phase : {PairPhase::began, PairPhase::touching, PairPhase::touching}) {
        const ReportHandle report = objects.scene.step();
        INFO(name_of(detail) << ", range " << range);
        REQUIRE(report->pairs().size() == 1);
        CHECK(report->pairs()[0].phase == phase);
        CHECK(report->pairs()[0].inside == Inside::crossing);
        CHECK(report->pairs()[0].distance.upper == 0);
        objects.scene.set_positions(objects.b, small.positions);
      }
    }
}

TEST_CASE("solids: what crosses follows groups of faces, and rows that ended say nothing of it") {
  std::array<std::size_t, 4> seen{};
  std::size_t ended = 0;
  std::size_t ended_where_pierced = 0;
  for (std::uint64_t seed = 0; seed < 80 + repeats(320); ++seed) {
    const RandomSolids given = oracle::random_solids(2 * seed + 1);
    oracle::Random random(seed);
    const auto groups_of = [&](const Shape& shape) {
      std::vector<std::uint8_t> groups;
      for (std::size_t face = 0; face < shape.faces.size(); ++face)
        groups.push_back(static_cast<std::uint8_t>(random.below(2)));
      return groups;
    };
    ObjectSettings of_a = solid_settings(given.solids.a);
    ObjectSettings of_b = solid_settings(given.solids.b);
    of_a.face_groups = groups_of(given.a);
    of_b.face_groups = groups_of(given.b);
    const ContactDetail detail = surface_details[seed % 4];
    Scene scene(settings_of(0, 20, detail));  // so that pairs end when nothing pierces any more
    const ObjectId a = scene.add(mesh_of(given.a), of_a);
    const ObjectId b = scene.add(mesh_of(given.b), of_b);
    std::set<std::pair<std::uint8_t, std::uint8_t>> ignored;
    bool was_pierced = false;
    for (int step = 0; step < 5; ++step) {
      const oracle::FacePairs pairs(given.a, given.b, [&](std::uint32_t face_a, std::uint32_t face_b) {
        return !ignored.contains({of_a.face_groups[face_a], of_b.face_groups[face_b]});
      });
      const ReportHandle report = scene.step();
      if (const PairReport* row = find_pair(*report, a, b); row != nullptr && pairs.are_some()) {
        INFO("seed " << seed << ", step " << step << ", detail " << name_of(detail));
        const Containment expected = oracle::containment(given.a, given.b, given.solids, pairs);
        CHECK(containment_of(row->inside) == expected);
        ++seen[static_cast<std::size_t>(expected)];
        if (row->phase == PairPhase::ended) {
          CHECK(row->inside == Inside::none);
          ++ended;
          ended_where_pierced += was_pierced ? 1U : 0U;
        }
        was_pierced = expected == Containment::crossing;
      }
      const auto group_a = static_cast<std::uint8_t>(random.below(2));
      const auto group_b = static_cast<std::uint8_t>(random.below(2));
      if (random.chance(0.7) && ignored.size() < 3) {
        ignored.insert({group_a, group_b});
        scene.ignore(a, group_a, b, group_b);
      } else {
        ignored.erase({group_a, group_b});
        scene.watch(a, group_a, b, group_b);
      }
    }
  }
  for (const std::size_t count : seen) CHECK(count > repeats(20));
  CHECK(ended > repeats(10));
  CHECK(ended_where_pierced > repeats(5));
}

TEST_CASE("solids: the push of an edge that pierces leads out, also of what is wound inside out") {
  std::size_t turned = 0;
  std::size_t straight = 0;
  std::size_t not_asked = 0;
  const auto check = [&](const RandomSolids& given, const FrameReport& report) {
    const oracle::WindingOracle about_a(given.a);
    const oracle::WindingOracle about_b(given.b);
    for (const Contact& contact : report.contacts()) {
      if (contact.kind != ContactKind::EF || contact.distance != 0) continue;
      const bool is_face_of_a = contact.feature_a.kind == FeatureKind::face;
      if (!(is_face_of_a ? given.solids.a : given.solids.b)) continue;
      // A move of b along the push is one of a against it.
      const Eigen::Vector3d way = contact.push() * (is_face_of_a ? 1e-6 : -1e-6);
      const oracle::WindingOracle& winding = is_face_of_a ? about_a : about_b;
      // Windings ahead and behind, at the place and around it on the face. Where these differ, another face
      // is there, too.
      const Eigen::Vector3d across = contact.normal.unitOrthogonal() * 1e-5;
      const Eigen::Vector3d along = contact.normal.cross(across);
      std::set<std::pair<int, int>> windings;
      for (const Eigen::Vector3d& beside :
           {Eigen::Vector3d(0 * across), across, along, Eigen::Vector3d(-across), Eigen::Vector3d(-along),
            Eigen::Vector3d(across + along)}) {
        const auto number_at = [&](const Eigen::Vector3d& point) {
          return std::abs(winding.about(contact.point_a + beside + point).number);
        };
        windings.emplace(number_at(way), number_at(-way));
      }
      const auto [ahead, behind] = *windings.begin();
      const auto is_here = [&](const Contact& each) {
        return each.kind == ContactKind::EF && (each.point_a - contact.point_a).norm() < 1e-9;
      };
      const bool is_alone = std::count_if(report.contacts().begin(), report.contacts().end(), is_here) == 1;
      if (!is_alone || windings.size() > 1 || std::abs(ahead - behind) != 1) continue;
      CHECK(contact.separation() == 0);
      // An edge that leads in from outside is not asked where nothing of its surface is where the solid is
      // inside out, though a solid may pass through itself on the way.
      const Shape& other = is_face_of_a ? given.b : given.a;
      const Feature& edge = is_face_of_a ? contact.feature_b : contact.feature_a;
      auto ends = oracle::edges_of(other)[edge.index];
      const Eigen::Vector3d normal = is_face_of_a ? contact.normal : Eigen::Vector3d(-contact.normal);
      if (normal.dot(other.positions[ends[1]] - other.positions[ends[0]]) > 0) std::swap(ends[0], ends[1]);
      const bool leads_in = winding.about(other.positions[ends[0]]).number == 0 &&
                            winding.about(other.positions[ends[1]]).number > 0;
      if (ahead > behind && leads_in)
        ++not_asked;
      else
        CHECK(ahead < behind);
      contact.push() == contact.normal ? ++straight : ++turned;
    }
  };
  for (std::uint64_t seed = 1; seed < 800; seed += 2) {
    INFO("seed " << seed);
    const RandomSolids given = oracle::random_solids(seed);
    TwoObjects objects(given, ContactDetail::nearest, 1);
    check(given, *objects.scene.step());
  }
  CHECK(turned > 50);
  CHECK(straight > 500);
  CHECK(not_asked < 20);
  // A box that was turned inside out since, by a mirror. The tip of the pin is inside.
  RandomSolids mirrored{oracle_box({-1, -1, -1}, {1, 1, 1}), pin({0.25, 0.125, 0.5}), {true, false}, 0};
  TwoObjects objects(mirrored, ContactDetail::nearest, 1);
  for (Eigen::Vector3d& position : mirrored.a.positions) position.x() = -position.x();
  objects.scene.set_positions(objects.a, mirrored.a.positions);
  turned = 0;
  check(mirrored, *objects.scene.step());
  CHECK(turned > 0);
}

TEST_CASE("solids: only closed surfaces are taken") {
  std::size_t refused = 0;
  std::size_t taken = 0;
  for (std::uint64_t seed = 1; seed < 200; seed += 2) {
    const RandomSolids given = oracle::random_solids(seed);
    for (const Shape* shape : {&given.a, &given.b}) {
      Scene scene;
      if (oracle::is_closed(*shape)) {
        CHECK_NOTHROW(scene.add(mesh_of(*shape), solid_settings(true)));
        ++taken;
      } else {
        CHECK_THROWS_AS(scene.add(mesh_of(*shape), solid_settings(true)), Error);
        ++refused;
      }
    }
  }
  CHECK(taken > 100);
  CHECK(refused > 10);
}

}  // namespace graze::tests
