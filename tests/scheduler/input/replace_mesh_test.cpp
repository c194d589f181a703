// Another mesh under the same id. Reports are compared with those of scenes built afresh, and what goes on
// from step to step with an oracle that maps features by their vertices.

#include <algorithm>
#include <array>
#include <deque>
#include <graze/error.hpp>
#include <iostream>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <tuple>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/error_of.hpp"

namespace graze::tests {
namespace {

using Map = std::vector<std::uint32_t>;
using Random = std::mt19937_64;

std::uint32_t below(Random& random, std::size_t count) {
  return static_cast<std::uint32_t>(random() % count);
}

/// A part of a sheet: some of its faces, with vertices in an order of its own.
struct Part {
  std::shared_ptr<const Mesh> mesh;
  Map whole;  ///< the sheet's vertex of each vertex
};

/// A sheet with bumps, of which parts are cut.
class Sheet {
 public:
  explicit Sheet(double height, std::uint64_t seed)
      : data_(models::sheet(7, 7, 2, 2, models::Faces::triangles)) {
    Random random(seed);
    std::uniform_real_distribution<double> bump(-0.06, 0.06);
    for (Eigen::Vector3d& point : data_.positions) point.z() = height + bump(random);
  }

  /// Leaves out up to a third of the faces, and numbers vertices and faces anew.
  [[nodiscard]] Part part(Random& random) const {
    std::vector<std::uint32_t> faces(data_.corner_counts.size());
    std::iota(faces.begin(), faces.end(), 0);
    std::shuffle(faces.begin(), faces.end(), random);
    faces.resize(faces.size() - below(random, faces.size() / 3));
    Part part;
    part.whole.resize(data_.positions.size());
    std::iota(part.whole.begin(), part.whole.end(), 0);
    if (random() % 2 == 0) std::shuffle(part.whole.begin(), part.whole.end(), random);
    std::vector<std::uint32_t> vertex_of(part.whole.size());
    for (std::uint32_t vertex = 0; vertex < part.whole.size(); ++vertex)
      vertex_of[part.whole[vertex]] = vertex;
    Positions rest;
    for (const std::uint32_t vertex : part.whole) rest.push_back(data_.positions[vertex]);
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t face : faces)
      for (std::size_t at = 0; at < 3; ++at) corners.push_back(vertex_of[data_.corners[3 * face + at]]);
    part.mesh = std::make_shared<const Mesh>(Mesh::from_triangles(rest, corners));
    return part;
  }

 private:
  models::MeshData data_;
};

/// Maps vertices by the sheet's, but for a few that go or become another one.
Map map_between(const Part& before, const Part& now, Random& random) {
  Map now_of(before.whole.size());
  for (std::uint32_t vertex = 0; vertex < now.whole.size(); ++vertex) now_of[now.whole[vertex]] = vertex;
  Map map;
  for (const std::uint32_t vertex : before.whole) {
    const auto chance = random() % 30;
    map.push_back(chance == 0   ? Mesh::no_vertex
                  : chance == 1 ? below(random, now.whole.size())
                                : now_of[vertex]);
  }
  return map;
}

// ---- The oracle

/// A feature by its kind and its vertices.
using Named = std::pair<FeatureKind, std::set<std::uint32_t>>;

Named named(const Mesh& mesh, const Feature& feature) {
  if (feature.kind == FeatureKind::vertex) return {feature.kind, {feature.index}};
  std::set<std::uint32_t> vertices;
  if (feature.kind == FeatureKind::edge)
    for (const std::uint32_t end : mesh.edge(feature.index)) vertices.insert(end);
  else
    for (const std::uint32_t corner : mesh.face(feature.index)) vertices.insert(corner);
  return {feature.kind, vertices};
}

/// The name after the vertices were mapped, or nothing if one of them is gone.
std::optional<Named> mapped(const Named& name, const std::vector<Map>& maps) {
  std::set<std::uint32_t> vertices;
  for (std::uint32_t vertex : name.second) {
    for (const Map& map : maps) vertex = vertex == Mesh::no_vertex ? vertex : map[vertex];
    if (vertex == Mesh::no_vertex) return std::nullopt;
    vertices.insert(vertex);
  }
  if (name.first == FeatureKind::edge && vertices.size() < 2) return std::nullopt;
  return Named{name.first, vertices};
}

/// Knows since when contacts are there, by the reports and the replacements between them.
class Ages {
 public:
  using Key = std::tuple<ObjectId, ObjectId, Named, Named>;

  /// Notes a replacement after the last report.
  void replace(ObjectId object, Map map) { maps_[object].push_back(std::move(map)); }
  /// Checks a report of objects that have these meshes.
  void check(const FrameReport& report, const Scene& scene) {
    std::map<Key, std::uint64_t> before;
    for (const auto& [key, since] : since_) {
      const auto& [a, b, name_a, name_b] = key;
      const auto now_a = mapped(name_a, maps_[a]);
      const auto now_b = mapped(name_b, maps_[b]);
      if (!now_a || !now_b) continue;
      const auto found = before.try_emplace(Key(a, b, *now_a, *now_b), since).first;
      found->second = std::min(found->second, since);
    }
    since_.clear();
    for (const PairReport& pair : report.pairs()) {
      check_phase(pair);
      for (const Contact& contact : report.contacts(pair)) {
        const Key key(pair.a, pair.b, named(*scene.mesh(pair.a), contact.feature_a),
                      named(*scene.mesh(pair.b), contact.feature_b));
        const auto found = before.find(key);
        const std::uint64_t since = found == before.end() ? report.frame() : found->second;
        if (contact.since != since) ++wrong;
        ++(since == report.frame() ? begun : kept);
        since_[key] = since;
      }
    }
    touching_.swap(touching_now_);
    touching_now_.clear();
    maps_.clear();
  }

  std::size_t wrong = 0, kept = 0, begun = 0, ended = 0;

 private:
  void check_phase(const PairReport& pair) {
    const bool was = touching_.contains({pair.a, pair.b});
    const bool is = pair.phase == PairPhase::began || pair.phase == PairPhase::touching;
    if (was != (pair.phase == PairPhase::touching || pair.phase == PairPhase::ended)) ++wrong;
    if (pair.phase == PairPhase::ended) ++ended;
    if (is) touching_now_.insert({pair.a, pair.b});
  }

  std::map<Key, std::uint64_t> since_;
  std::map<ObjectId, std::vector<Map>> maps_;
  std::set<std::pair<ObjectId, ObjectId>> touching_, touching_now_;
};

// ---- A scene in which meshes are cut

constexpr double range = 0.2;

/// Two sheets over each other, and a ball that touches one. Its first sheet is bound or copied, and the
/// second one posed.
class CutScene {
 public:
  CutScene(const SceneSettings& settings, std::uint64_t seed)
      : settings_(settings), random_(seed), sheets_{Sheet(0, 1), Sheet(0.06, 2)}, scene_(settings) {
    for (std::size_t i = 0; i < 2; ++i) {
      parts_[i] = sheets_[i].part(random_);
      ids_.push_back(scene_.add(parts_[i].mesh, motion_of(i == 0 ? Motion::deformable : Motion::rigid)));
    }
    ball_ = mesh_of(models::sphere(8, 5, models::Faces::triangles));
    ids_.push_back(scene_.add(ball_, motion_of(Motion::fixed)));
    scene_.set_pose(ids_[2], lift_pose(-1.02));
  }

  void cut(std::size_t sheet) {
    Part now = sheets_[sheet].part(random_);
    Map map = map_between(parts_[sheet], now, random_);
    scene_.replace_mesh(ids_[sheet], now.mesh, map);
    ages.replace(ids_[sheet], std::move(map));
    parts_[sheet] = std::move(now);
    if (sheet == 0) is_at_rest_ = true;
  }
  void move() {
    const double height = 0.02 * static_cast<double>(below(random_, 5)) - 0.04;
    if (random_() % 3 == 0) {
      pose_ = lift_pose(height);
      scene_.set_pose(ids_[1], pose_);
      return;
    }
    positions_ = lifted(*parts_[0].mesh, height);
    is_at_rest_ = false;
    if (random_() % 2 == 0)
      scene_.bind_positions(ids_[0], PositionView(positions_));
    else
      scene_.set_positions(ids_[0], PositionView(positions_));
  }
  /// Steps, and checks the report against a scene built afresh and against the ages.
  void step() {
    const ReportHandle report = scene_.step();
    Scene afresh(settings_);
    const ObjectId first = afresh.add(parts_[0].mesh);
    if (!is_at_rest_) afresh.set_positions(first, PositionView(positions_));
    afresh.set_pose(afresh.add(parts_[1].mesh, motion_of(Motion::rigid)), pose_);
    afresh.set_pose(afresh.add(ball_, motion_of(Motion::fixed)), lift_pose(-1.02));
    if (timeless_rows_of(*report, range) != timeless_rows_of(*afresh.step(), range)) ++different;
    if (inconsistency_of(*report) != "" || !report->diagnostics().empty()) ++different;
    ages.check(*report, scene_);
  }
  Random& random() { return random_; }

  Ages ages;
  std::size_t different = 0;

 private:
  SceneSettings settings_;
  Random random_;
  std::array<Sheet, 2> sheets_;
  Scene scene_;
  std::array<Part, 2> parts_;
  std::vector<ObjectId> ids_;
  std::shared_ptr<const Mesh> ball_;
  Positions positions_;
  bool is_at_rest_ = true;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
};

/// Two quads in the plane z = 0, one at either side of x = 0, and two triangles in the place of the second.
std::shared_ptr<const Mesh> two_quads() {
  return std::make_shared<const Mesh>(
      Mesh::from_quads(Positions{{-2, -1, 0}, {0, -1, 0}, {2, -1, 0}, {-2, 1, 0}, {0, 1, 0}, {2, 1, 0}},
                       std::vector<std::array<std::uint32_t, 4>>{{0, 1, 4, 3}, {1, 2, 5, 4}}));
}

/// A triangle whose tip, vertex 0, points down at (x, 0.25, height).
std::shared_ptr<const Mesh> tip_at(double x, double height) {
  return std::make_shared<const Mesh>(
      Mesh::from_triangles(Positions{{x, 0.25, height}, {x, 0.25, height + 1}, {x + 0.1, 0.25, height + 1}},
                           std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
}

Map identity(std::size_t count) {
  Map map(count);
  std::iota(map.begin(), map.end(), 0);
  return map;
}

}  // namespace

static_assert(all_details.size() == 6, "add the number of a new detail to each list of numbers here");

TEMPLATE_TEST_CASE_SIG("replaced meshes: reports of a scene built afresh, phases and ages, detail", "",
                       ((int number), number), 1, 3, 4, 5) {
  SceneSettings settings = settings_of(0.05, range, static_cast<ContactDetail>(number));
  settings.threads = 2;
  CutScene scene(settings, 11);
  std::size_t replaced = 0;
  while (replaced < 350) {
    const auto chance = scene.random()() % 8;
    if (chance < 7) scene.cut(chance % 2), ++replaced;
    if (chance == 2) scene.cut(1), ++replaced;
    if (chance == 3) scene.cut(1), ++replaced;
    if (chance > 3) scene.move();
    scene.step();
  }
  CHECK(scene.different == 0);
  CHECK(scene.ages.wrong == 0);
  CHECK(scene.ages.kept > 20);
  CHECK(scene.ages.begun > 100);
  std::cout << "replaced " << replaced << " meshes, " << scene.ages.kept << " contacts went on, "
            << scene.ages.begun << " began, " << scene.ages.ended << " pairs ended\n";
}

TEST_CASE("a replaced mesh: what survives keeps its age") {
  const auto quads = two_quads();
  Scene scene(settings_of(0.1, 1));
  const ObjectId floor = scene.add(quads);
  const ObjectId left = scene.add(tip_at(-1, 0.05));
  const ObjectId right = scene.add(tip_at(1, 0.05));
  const std::uint64_t began = scene.step()->frame();
  // The left quad stays under other numbers. The right one becomes two triangles.
  const auto cut = std::make_shared<const Mesh>(Mesh::from_polygons(
      Positions{{2, 1, 0}, {0, 1, 0}, {-2, 1, 0}, {2, -1, 0}, {0, -1, 0}, {-2, -1, 0}},
      std::vector<std::uint32_t>{4, 3, 0, 4, 0, 1, 1, 2, 5, 4}, std::vector<std::uint32_t>{3, 3, 4}));
  scene.replace_mesh(floor, cut, Map{5, 4, 3, 2, 1, 0});
  CHECK(scene.mesh(floor) == cut);
  const ReportHandle report = scene.step();
  const auto only_contact = [&](ObjectId tip) {
    const PairReport* const row = find_pair(*report, floor, tip);
    REQUIRE(row != nullptr);
    CHECK(row->phase == PairPhase::touching);
    REQUIRE(row->contact_count == 1);
    return report->contacts(*row)[0];
  };
  CHECK(only_contact(left).feature_a == Feature{FeatureKind::face, 2});
  CHECK(only_contact(left).since == began);
  CHECK(only_contact(right).feature_a == Feature{FeatureKind::face, 1});
  CHECK(only_contact(right).since == report->frame());
}

TEST_CASE("a replaced mesh: of two faces with the same vertices each keeps its contact") {
  const Positions rest{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}};
  const auto twice = std::make_shared<const Mesh>(
      Mesh::from_triangles(rest, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 1}}));
  Scene scene(settings_of(0.1, 1));
  const ObjectId floor = scene.add(twice);
  scene.add(tip_at(0, 0.05));
  const std::size_t count = scene.step()->contacts().size();
  scene.replace_mesh(floor, twice, identity(3));
  const ReportHandle report = scene.step();
  REQUIRE(report->contacts().size() == count);
  for (const Contact& contact : report->contacts()) CHECK(contact.since == 1);
}

TEST_CASE("a replaced mesh: pairs of other objects rest, and the scene takes calls for the new mesh") {
  const auto quads = two_quads();
  Scene scene(settings_of(0.1, 1));
  const ObjectId floor = scene.add(quads);
  const ObjectId tip = scene.add(tip_at(-1, 0.05));
  const ObjectId other_floor = scene.add(mesh_of(models::sheet(2, 2, 2, 2)), motion_of(Motion::rigid));
  const ObjectId other_tip = scene.add(tip_at(0.3, 10.05), motion_of(Motion::rigid));
  scene.set_pose(other_floor, lift_pose(10));
  for (int i = 0; i < 3; ++i) scene.step();
  const auto needle = tip_at(0, 5);
  scene.replace_mesh(tip, needle, identity(3));
  const ReportHandle away = scene.step();
  CHECK(find_pair(*away, floor, tip)->phase == PairPhase::ended);
  CHECK(find_pair(*away, other_floor, other_tip)->phase == PairPhase::touching);
  CHECK(away->statistics().pairs_unchanged == 1);
  CHECK(away->statistics().pairs_tested == 1);
  // A mesh of another size, with positions before and after.
  scene.set_positions(tip, PositionView(needle->rest()));
  scene.replace_mesh(tip, two_quads(), Map(3, Mesh::no_vertex));
  scene.set_positions(tip, PositionView(needle->rest()));
  const Positions above = lifted(*quads, 0.05);
  scene.set_positions(tip, PositionView(above));
  const ReportHandle back = scene.step();
  REQUIRE(kinds_of(*back) == std::vector<DiagnosticKind>{DiagnosticKind::wrong_count});
  CHECK(find_pair(*back, floor, tip)->distance.upper == 0.05);
}

TEST_CASE("a replaced mesh: bindings end, bad input is forgotten, poses stay") {
  Scene scene(settings_of(0.1, 10));
  const ObjectId floor = scene.add(two_quads());
  const auto tip = tip_at(0.5, 0.5);
  const ObjectId bound = scene.add(tip);
  const ObjectId posed = scene.add(tip, motion_of(Motion::rigid));
  Positions positions = lifted(*tip, 1);
  scene.bind_positions(bound, PositionView(positions));
  scene.set_pose(posed, lift_pose(2));
  const auto height = [&](const ReportHandle& report, ObjectId object) {
    return find_pair(*report, floor, object)->distance.upper;
  };
  CHECK(height(scene.step(), bound) == 1.5);
  positions[0].x() = std::numeric_limits<double>::quiet_NaN();
  Eigen::Isometry3d mirrored = lift_pose(3);
  mirrored.linear()(0, 0) = -1;
  scene.set_pose(posed, mirrored);
  CHECK(find_pair(*scene.step(), floor, bound)->stale);
  const auto lower = tip_at(0.5, 0.25);
  for (const ObjectId object : {bound, posed}) scene.replace_mesh(object, lower, identity(3));
  positions = lifted(*lower, 7);
  const ReportHandle report = scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(height(report, bound) == 0.25);
  CHECK(!find_pair(*report, floor, bound)->stale);
  // Its pose was refused, and no good one has come.
  CHECK(height(report, posed) == 2.5);
  CHECK(find_pair(*report, floor, posed)->stale);
  scene.set_pose(posed, lift_pose(2));
  CHECK(height(scene.step(), posed) == 2.25);
  scene.replace_mesh(posed, tip, identity(3));
  CHECK(height(scene.step(), posed) == 2.5);
}

TEST_CASE("a replaced mesh: a stale row has the contacts whose features survive") {
  Scene scene(settings_of(0.1, 1));
  const ObjectId floor = scene.add(two_quads());
  const ObjectId left = scene.add(tip_at(-1, 0.05));
  const ObjectId right = scene.add(tip_at(1, 0.05));
  scene.step();
  const auto other = std::make_shared<const Mesh>(
      Mesh::from_quads(Positions{{9, 9, 9}, {0, 1, 0}, {-2, 1, 0}, {0, -1, 0}, {-2, -1, 0}},
                       std::vector<std::array<std::uint32_t, 4>>{{4, 3, 1, 2}}));
  scene.replace_mesh(floor, other, Map{4, 3, Mesh::no_vertex, 2, 1, Mesh::no_vertex});
  Positions bad(5, Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()));
  scene.bind_positions(floor, PositionView(bad));
  const ReportHandle report = scene.step();
  const PairReport* const kept = find_pair(*report, floor, left);
  CHECK((kept->stale && kept->phase == PairPhase::touching && kept->contact_count == 1));
  CHECK(report->contacts(*kept)[0].feature_a == Feature{FeatureKind::face, 0});
  CHECK(report->contacts(*kept)[0].since == 1);
  CHECK(kept->witness.feature_a == Feature{FeatureKind::face, 0});
  const PairReport* const gone = find_pair(*report, floor, right);
  CHECK((gone->stale && gone->phase == PairPhase::touching && gone->contact_count == 0));
  CHECK(gone->witness.feature_a == Feature{FeatureKind::vertex, Mesh::no_vertex});
  // Once more, while the last row names no feature.
  scene.replace_mesh(floor, two_quads(), Map(5, 0));
  scene.bind_positions(floor, PositionView(bad));
  scene.replace_mesh(floor, other, Map(6, 0));
  scene.bind_positions(floor, PositionView(bad));
  const ReportHandle again = scene.step();
  CHECK(find_pair(*again, floor, right)->witness.feature_a == Feature{FeatureKind::vertex, Mesh::no_vertex});
}

TEST_CASE("a replaced mesh: a stale row has no region distances, which are of the old mesh") {
  SceneSettings settings = settings_of(0.1, 4);
  settings.region_distances = 100;
  Scene scene(settings);
  const auto sheet = mesh_of(models::sheet(8, 8, 2, 2));
  const ObjectId floor = scene.add(sheet);
  scene.add(mesh_of(models::sphere(8, 5)));
  CHECK(!scene.step()->region_distances().empty());
  scene.replace_mesh(floor, sheet, identity(sheet->vertex_count()));
  const Positions bad(sheet->vertex_count(),
                      Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()));
  scene.bind_positions(floor, PositionView(bad));
  const ReportHandle report = scene.step();
  CHECK(only_pair(*report).stale);
  CHECK(report->region_distances().empty());
  scene.set_positions(floor, PositionView(sheet->rest()));
  CHECK(!scene.step()->region_distances().empty());
}

TEST_CASE("replaced meshes: positions and bindings of other threads come before or after") {
  const std::array meshes{two_quads(), tip_at(0, 0.05)};
  Scene scene(settings_of(0.1, 1));
  const ObjectId floor = scene.add(two_quads());
  const ObjectId object = scene.add(meshes[0]);
  constexpr std::size_t rounds = 400;
  std::deque<Positions> memory;  // of all bindings, until no step runs any more
  std::thread replaces([&] {
    for (std::size_t i = 1; i <= rounds; ++i)
      scene.replace_mesh(object, meshes[i % 2], Map(meshes[(i + 1) % 2]->vertex_count(), 0));
  });
  std::thread copies([&] {
    for (std::size_t i = 0; i < rounds; ++i)
      scene.set_positions(object, lifted(*scene.mesh(object), 0.01 * static_cast<double>(i % 9)));
  });
  std::thread binds([&] {
    for (std::size_t i = 0; i < rounds; ++i) {
      memory.push_back(lifted(*scene.mesh(object), 0.05));
      scene.bind_positions(object, PositionView(memory.back()));
      if (i % 3 == 0) scene.unbind_positions(object);
    }
  });
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rounds; ++i) {
    const ReportHandle report = scene.step();
    if (inconsistency_of(*report) != "") ++wrong;
    for (const DiagnosticKind kind : kinds_of(*report))
      if (kind != DiagnosticKind::wrong_count) ++wrong;
  }
  for (std::thread* const thread : {&replaces, &copies, &binds}) thread->join();
  CHECK(wrong == 0);
  CHECK(scene.mesh(object) == meshes[0]);
  scene.set_positions(object, lifted(*meshes[0], 0.03125));
  CHECK(find_pair(*scene.step(), floor, object)->distance.upper == 0.03125);
}

TEST_CASE("replace_mesh: bad input throws, and a stale id is told") {
  Scene scene(settings_of(0.1, 1));
  const auto quads = two_quads();
  const auto tip = tip_at(-1, 0.05);
  const ObjectId floor = scene.add(quads);
  scene.add(tip);
  scene.step();
  const std::vector<std::uint8_t> groups{1, 2, 3};
  CHECK(error_of([&] { scene.replace_mesh(floor, nullptr, identity(6)); }) ==
        "replace_mesh: there is no mesh");
  CHECK(error_of([&] { scene.replace_mesh(floor, tip, identity(3)); }) ==
        "replace_mesh: object 0 has 6 vertices, but new_of_old has 3 entries");
  CHECK(error_of([&] {
          scene.replace_mesh(floor, tip, Map{0, 1, 2, 3, 0, 0});
        }) == "replace_mesh: new_of_old maps vertex 3 to 3, but the new mesh has 3 vertices");
  CHECK(error_of([&] { scene.replace_mesh(floor, tip, Map(6, 0), groups); }) ==
        "replace_mesh: face_groups has 3 groups for 1 faces; give one for each face, or none");
  CHECK(scene.mesh(floor) == quads);
  const ReportHandle same = scene.step();
  CHECK(same->diagnostics().empty());
  CHECK(same->statistics().pairs_tested == 0);
  scene.remove(floor);
  scene.replace_mesh(floor, tip, Map(6, 0));
  CHECK(kinds_of(*scene.step()) == std::vector<DiagnosticKind>{DiagnosticKind::stale_id});
}

TEST_CASE("a replaced mesh: a promise counts from where a step saw the new mesh") {
  Scene scene(settings_of(0.1, 1));
  scene.add(two_quads());
  const auto far = tip_at(0.5, 30);
  const ObjectId tip = scene.add(far);
  scene.step();
  scene.replace_mesh(tip, tip_at(0.5, 20), identity(3));
  // The first promise counts from where no step has seen the new mesh, so that it cannot be broken.
  scene.set_positions(tip, PositionView(far->rest()), 1);
  CHECK(scene.step()->diagnostics().empty());
  scene.replace_mesh(tip, far, identity(3));
  scene.step();
  const Positions near = lifted(*far, -29.95);
  scene.set_positions(tip, PositionView(near), 1);
  const ReportHandle report = scene.step();
#ifndef GRAZE_VALIDATE
  CHECK(report->statistics().objects_unread == 1);
#else
  CHECK(kinds_of(*report) == std::vector<DiagnosticKind>{DiagnosticKind::broken_promise});
#endif
}

}  // namespace graze::tests
