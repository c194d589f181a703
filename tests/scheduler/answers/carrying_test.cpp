// Contacts that carry, in scenes: what is listed does not jump when a body trembles, spans what it rests on,
// and is the same for any number of threads.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;

constexpr double contact_distance = 0.02;
/// A limit of so many is none here, since no pair has as many contacts.
constexpr std::size_t all_of_them = 100000;

Vector3d middle_of(const Contact& contact) {
  return (contact.point_a + contact.point_b) / 2;
}

auto key_of(const Contact& contact) {
  return std::tuple(contact.kind, contact.feature_a, contact.feature_b);
}

std::vector<Contact> copy_of(std::span<const Contact> contacts) {
  return {contacts.begin(), contacts.end()};
}

/// A cylinder about the y axis that lies on one of its sides.
models::MeshData lying_cylinder(std::uint32_t sides, double radius, double length) {
  models::MeshData data;
  for (const double y : {-length / 2, length / 2})
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / sides - std::numbers::pi / 2;
      data.positions.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
  const auto at = static_cast<std::uint32_t>(data.positions.size());
  data.positions.emplace_back(0, -length / 2, 0);
  data.positions.emplace_back(0, length / 2, 0);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    data.add_face({i, i + sides, next + sides, next});
    data.add_face({at, i, next});
    data.add_face({at + 1, next + sides, i + sides});
  }
  return data;
}

models::MeshData ball(double radius) {
  models::MeshData data = models::sphere(32, 15);
  for (Vector3d& position : data.positions) position *= radius;
  return data;
}

SceneSettings settings_with(std::size_t carrying) {
  SceneSettings settings = settings_of(contact_distance, contact_distance, ContactDetail::nearest);
  settings.threads = 1;
  settings.carrying = carrying;
  return settings;
}

/// A rigid solid on a terrain of cells of 5 cm, which is fixed.
class OnTerrain {
 public:
  OnTerrain(const SceneSettings& settings, const models::MeshData& body, bool is_ground_solid = false)
      : scene_(settings) {
    ObjectSettings ground = motion_of(Motion::fixed);
    ground.solid = is_ground_solid;
    scene_.add(mesh_of(is_ground_solid ? models::box({3, 3, 1}) : models::sheet(60, 60, 3, 3)), ground);
    ObjectSettings solid = motion_of(Motion::rigid);
    solid.solid = true;
    body_ = scene_.add(mesh_of(body), solid);
    top_ = is_ground_solid ? 0.5 : 0;
  }
  /// Steps with the body's middle at a place above the ground.
  ReportHandle step_at(const Vector3d& place, const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = turn;
    pose.translation() = place + Vector3d(0, 0, top_);
    scene_.set_pose(body_, pose);
    return scene_.step();
  }

 private:
  Scene scene_;
  ObjectId body_;
  double top_ = 0;
};

/// How far what is listed now is from the nearest of what was listed, at most.
double jump_of(std::span<const Contact> now, std::span<const Contact> before) {
  double most = 0;
  for (const Contact& contact : now) {
    double least = std::numeric_limits<double>::infinity();
    for (const Contact& other : before)
      least = std::min(least, (middle_of(contact) - middle_of(other)).norm());
    most = std::max(most, least);
  }
  return most;
}

struct Body {
  std::string name;
  models::MeshData data;
  double height;  ///< of its middle, where it rests
};

std::vector<Body> bodies() {
  return {{"cylinder", lying_cylinder(32, 0.25, 0.6), 0.25 * std::cos(std::numbers::pi / 32)},
          {"ball", ball(0.25), 0.25},
          {"box", models::box({0.5, 0.5, 0.5}), 0.25},
          {"plank", models::box({1.2, 0.24, 0.1}), 0.05}};
}

/// The largest jump of what is listed of a body that moves by 0.1 µm in each step, in all directions.
double largest_jump(const Body& body, const SceneSettings& settings, bool is_ground_solid) {
  std::mt19937 random(1);
  std::normal_distribution<double> way;
  double largest = 0;
  OnTerrain stage(settings, body.data, is_ground_solid);
  Vector3d place(0.0125, 0.0375, body.height);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vector3d::UnitZ()).toRotationMatrix();
  std::vector<Contact> before;
  for (int step = 0; step < 150; ++step) {
    place += 1e-7 * Vector3d{way(random), way(random), way(random)}.normalized();
    const double angle = 1e-7 * way(random);
    const Eigen::Matrix3d tremble =
        Eigen::AngleAxisd(angle, Vector3d{way(random), way(random), way(random)}.normalized())
            .toRotationMatrix();
    const ReportHandle report = stage.step_at(place, tremble * turn);
    REQUIRE(!report->contacts().empty());
    if (!before.empty()) largest = std::max(largest, jump_of(report->contacts(), before));
    before = copy_of(report->contacts());
  }
  return largest;
}

}  // namespace

TEST_CASE("carrying: what is listed of a body at rest moves by less than a millimetre as it trembles") {
  double largest_of_limit = 0;
  for (const Body& body : bodies())
    for (const bool is_ground_solid : {false, true})
      for (const std::size_t count : {3U, 4U, 8U}) {
        SceneSettings limited = settings_with(0);
        limited.max_contacts_per_pair = count;
        const double with_carrying = largest_jump(body, settings_with(count), is_ground_solid);
        const double with_limit = largest_jump(body, limited, is_ground_solid);
        largest_of_limit = std::max(largest_of_limit, with_limit);
        UNSCOPED_INFO(body.name << (is_ground_solid ? " on solid ground, " : " on a terrain, ") << count
                                << " contacts: " << 1000 * with_carrying << " mm, with a limit "
                                << 1000 * with_limit << " mm");
        CHECK(with_carrying < 1e-3);
      }
  CHECK(largest_of_limit > 0.05);  // what this is for
}

TEST_CASE("carrying: four contacts span a box that lies on a terrain") {
  OnTerrain stage(settings_with(4), models::box({0.6, 0.4, 0.2}));
  for (int step = 0; step < 20; ++step) {
    const ReportHandle report = stage.step_at({0.01 * step, 0.003 * step, 0.1});
    const auto contacts = report->contacts();
    REQUIRE(contacts.size() == 4);
    Eigen::AlignedBox3d box;
    for (const Contact& contact : contacts) box.extend(middle_of(contact));
    CHECK(box.sizes().x() * box.sizes().y() > 0.8 * 0.6 * 0.4);
    CHECK_FALSE(report->pairs()[0].contacts_cut);
    CHECK(report->complete());
  }
}

TEST_CASE("carrying: what is listed are contacts of the whole report, and all else is as without") {
  OnTerrain chosen(settings_with(4), ball(0.25));
  OnTerrain whole(settings_with(0), ball(0.25));
  OnTerrain most(settings_with(all_of_them), ball(0.25));
  std::size_t ages = 0;
  for (int step = 0; step < 20; ++step) {
    const Vector3d place(0.004 * step, 0.002 * step, 0.24 + 0.001 * step);
    const ReportHandle few = chosen.step_at(place);
    const ReportHandle all = whole.step_at(place);
    const ReportHandle many = most.step_at(place);
    CHECK(inconsistency_of(*few) == "");
    REQUIRE(few->contacts().size() == 4);
    CHECK(all->contacts().size() >= many->contacts().size());
    CHECK(few->pairs()[0].phase == all->pairs()[0].phase);
    CHECK(few->pairs()[0].inside == all->pairs()[0].inside);
    CHECK(few->pairs()[0].distance.lower == all->pairs()[0].distance.lower);
    CHECK(few->pairs()[0].witness.feature_b == all->pairs()[0].witness.feature_b);
    CHECK(few->statistics().contacts == 4);
    CHECK(few->statistics().contacts_left_out == 0);
    for (const Contact& contact : few->contacts()) {
      CHECK(std::any_of(all->contacts().begin(), all->contacts().end(), [&](const Contact& other) {
        return key_of(other) == key_of(contact) && other.point_a == contact.point_a;
      }));
      ages = std::max(ages, few->age(contact));
    }
  }
  CHECK(ages > 2);
}

TEST_CASE("carrying: with other details it has no effect") {
  for (const ContactDetail detail :
       {ContactDetail::closest, ContactDetail::features, ContactDetail::vertices}) {
    std::array<std::vector<std::string>, 2> texts;
    for (const std::size_t carrying : {0U, 1U}) {
      SceneSettings settings = settings_with(carrying);
      settings.detail = detail;
      texts.at(carrying) = rows_of(*OnTerrain(settings, ball(0.25)).step_at({0, 0, 0.25}));
    }
    CHECK(texts[0] == texts[1]);
  }
}

TEST_CASE("carrying: a limit for each pair leaves the lesser number, and says so where it cuts") {
  for (const std::size_t limit : {2U, 4U, 6U}) {
    SceneSettings settings = settings_with(4);
    settings.max_contacts_per_pair = limit;
    const ReportHandle report = OnTerrain(settings, models::box({0.5, 0.5, 0.5})).step_at({0.01, 0.02, 0.25});
    CHECK(report->contacts().size() == std::min<std::size_t>(limit, 4));
    CHECK(report->pairs()[0].contacts_cut == (limit < 4));
    CHECK(report->complete() == (limit >= 4));
  }
  SceneSettings settings = settings_with(4);
  settings.max_contacts = 3;
  const ReportHandle report = OnTerrain(settings, models::box({0.5, 0.5, 0.5})).step_at({0.01, 0.02, 0.25});
  CHECK(report->contacts().size() == 3);
  CHECK(report->pairs()[0].contacts_cut);
}

TEST_CASE("carrying: a step in which nothing moves repeats the list") {
  OnTerrain stage(settings_with(6), lying_cylinder(32, 0.25, 0.6));
  const std::vector<Contact> first = copy_of(stage.step_at({0.01, 0.02, 0.25})->contacts());
  for (int step = 0; step < 4; ++step) {
    const ReportHandle report = stage.step_at({0.01, 0.02, 0.25});
    REQUIRE(report->contacts().size() == first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      CHECK(key_of(report->contacts()[i]) == key_of(first[i]));
      CHECK(report->contacts()[i].since == 1);
    }
  }
}

TEST_CASE("carrying: a heap of bodies has the same lists with any number of threads") {
  const std::array meshes{mesh_of(ball(0.25)), mesh_of(models::box({0.4, 0.4, 0.4})),
                          mesh_of(lying_cylinder(16, 0.2, 0.5))};
  std::array<std::vector<std::string>, 3> texts;
  for (std::size_t run = 0; run < texts.size(); ++run) {
    SceneSettings settings = settings_with(3);
    settings.threads = static_cast<unsigned>(1 + run);
    settings.carrying_band = 0.01;
    if (run == 2) settings.max_contacts = all_of_them;
    Scene scene(settings);
    std::mt19937 random(4);
    std::normal_distribution<double> jolt(0, 0.01);
    std::vector<ObjectId> ids;
    ObjectSettings solid = motion_of(Motion::rigid);
    solid.solid = true;
    for (std::size_t i = 0; i < 24; ++i) ids.push_back(scene.add(meshes.at(i % 3), solid));
    for (int step = 0; step < 10; ++step) {
      for (std::size_t i = 0; i < ids.size(); ++i) {
        const Vector3d cell(static_cast<double>(i % 3), static_cast<double>(i / 3 % 3),
                            static_cast<double>(i / 9));
        scene.set_pose(ids[i], Eigen::Isometry3d(Eigen::Translation3d(
                                   0.42 * cell + Vector3d{jolt(random), jolt(random), jolt(random)})));
      }
      const ReportHandle report = scene.step();
      REQUIRE(report->statistics().pairs_in_contact > 10);
      for (const std::string& row : rows_of(*report)) texts.at(run).push_back(row);
    }
  }
  CHECK(texts[0] == texts[1]);
  CHECK(texts[0] == texts[2]);
}

TEST_CASE("carrying: a band that is no distance is refused") {
  for (const double band : {-0.01, std::numeric_limits<double>::infinity(), std::nan("")}) {
    SceneSettings settings = settings_with(4);
    settings.carrying_band = band;
    CHECK_THROWS_WITH(Scene(settings), Catch::Matchers::Contains("carrying_band"));
  }
}

}  // namespace graze::tests
