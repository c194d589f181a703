// Limits of contacts: what is kept are the nearest of all, or with `nearest` the deepest, whoever finds them
// in whichever order. All else is said of all contacts.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "scheduler/moving_scene.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"

namespace graze::tests {
namespace {

using Limit = std::optional<std::size_t>;

constexpr std::array listed_details{ContactDetail::regions, ContactDetail::vertices, ContactDetail::features,
                                    ContactDetail::nearest};

auto features_of(const Contact& contact) {
  return std::tuple(contact.kind, contact.feature_a, contact.feature_b);
}

/// The limits of a report, and the detail that says by what it keeps contacts.
struct Limits {
  ContactDetail detail;
  Limit of_all;
  Limit of_pair;

  /// What is lower is kept before.
  [[nodiscard]] std::tuple<bool, double> rank(const Contact& contact) const {
    if (detail != ContactDetail::nearest) return {false, contact.distance};
    return {contact.kind == ContactKind::EF && contact.distance == 0, contact.separation()};
  }
};

/// The contacts that a report is to keep, by the number of their pair, from one without limits.
std::map<std::size_t, std::vector<Contact>> kept_of(const FrameReport& whole, const Limits& limits) {
  std::vector<std::pair<std::size_t, Contact>> all;
  for (std::size_t pair = 0; pair < whole.pairs().size(); ++pair) {
    const auto given = whole.contacts(whole.pairs()[pair]);
    std::vector<Contact> contacts(given.begin(), given.end());
    std::sort(contacts.begin(), contacts.end(), [&](const Contact& left, const Contact& right) {
      return std::tuple(limits.rank(left), features_of(left)) <
             std::tuple(limits.rank(right), features_of(right));
    });
    contacts.resize(std::min(contacts.size(), limits.of_pair.value_or(contacts.size())));
    for (const Contact& contact : contacts) all.emplace_back(pair, contact);
  }
  std::sort(all.begin(), all.end(), [&](const auto& left, const auto& right) {
    return std::tuple(limits.rank(left.second), left.first, features_of(left.second)) <
           std::tuple(limits.rank(right.second), right.first, features_of(right.second));
  });
  all.resize(std::min(all.size(), limits.of_all.value_or(all.size())));
  std::map<std::size_t, std::vector<Contact>> kept;
  for (const auto& [pair, contact] : all) kept[pair].push_back(contact);
  for (auto& [pair, contacts] : kept)
    std::sort(contacts.begin(), contacts.end(), [](const Contact& left, const Contact& right) {
      return features_of(left) < features_of(right);
    });
  return kept;
}

bool are_same(const Contact& left, const Contact& right) {
  return features_of(left) == features_of(right) && left.distance == right.distance &&
         left.point_a == right.point_a && left.point_b == right.point_b && left.normal == right.normal &&
         left.side_a == right.side_a && left.side_b == right.side_b;
}

/// Compares a report with what it would be without limits. Returns how many pairs are cut.
std::size_t compare(const FrameReport& report, const FrameReport& whole, const Limits& limits) {
  const auto kept = kept_of(whole, limits);
  REQUIRE(report.pairs().size() == whole.pairs().size());
  CHECK(inconsistency_of(report) == "");
  std::size_t cut = 0;
  for (std::size_t i = 0; i < report.pairs().size(); ++i) {
    const PairReport& pair = report.pairs()[i];
    const PairReport& expected = whole.pairs()[i];
    REQUIRE(pair.a == expected.a);
    REQUIRE(pair.b == expected.b);
    CHECK(pair.phase == expected.phase);
    CHECK(pair.distance.lower == expected.distance.lower);
    CHECK(pair.distance.upper == expected.distance.upper);
    CHECK(pair.witness.feature_a == expected.witness.feature_a);
    CHECK(pair.witness.feature_b == expected.witness.feature_b);
    CHECK(pair.witness.point_a == expected.witness.point_a);
    const auto contacts = report.contacts(pair);
    const auto found = kept.find(i);
    const std::vector<Contact> wanted = found == kept.end() ? std::vector<Contact>() : found->second;
    REQUIRE(std::equal(contacts.begin(), contacts.end(), wanted.begin(), wanted.end(), are_same));
    const bool is_cut = wanted.size() < expected.contact_count;
    CHECK(pair.contacts_cut == is_cut);
    CHECK(pair.complete == !is_cut);
    cut += is_cut ? 1U : 0U;
  }
  const StepStatistics& statistics = report.statistics();
  CHECK(statistics.contacts == report.contacts().size());
  CHECK(statistics.pairs_cut == cut);
  CHECK(statistics.contacts_left_out >= cut);
  CHECK(statistics.contacts_left_out <= whole.contacts().size() - report.contacts().size());
  if (!limits.of_pair && !limits.of_all) CHECK(statistics.contacts_left_out == 0);
  CHECK(report.complete() == (cut == 0));
  return cut;
}

}  // namespace

TEST_CASE("limits: the nearest contacts of each pair and of all are kept, step by step, by any threads") {
  const MovingScene moving;
  constexpr std::size_t frames = 10;
  for (const ContactDetail detail : listed_details) {
    SceneSettings settings = settings_of(0.3, 0.4, detail);
    std::size_t cut = 0;
    const auto whole = moving.play(settings, frames);
    for (const auto& [of_all, of_pair] : {std::pair<Limit, Limit>(std::nullopt, 1),
                                          {std::nullopt, 7},
                                          {1, std::nullopt},
                                          {40, std::nullopt},
                                          {40, 7},
                                          {100000, 100000}}) {
      settings.max_contacts = of_all;
      settings.max_contacts_per_pair = of_pair;
      for (const unsigned threads : {1U, 3U}) {
        settings.threads = threads;
        const auto limited = moving.play(settings, frames);
        for (std::size_t frame = 0; frame < frames; ++frame)
          cut += compare(*limited[frame], *whole[frame], {detail, of_all, of_pair});
      }
    }
    CHECK(cut > 50);
  }
}

TEST_CASE("limits: of contacts that are as near, names say which are kept") {
  // Flat grids on each other and a little apart: all distances are the same.
  const std::uint32_t cells = at_full_effort ? 40 : 16;
  const auto sheet = mesh_of(models::sheet(cells, cells, 1, 1));
  for (const ContactDetail detail : listed_details)
    for (const double gap : {0.0, 0.0625}) {
      SceneSettings settings = settings_of(0.125, 0.125, detail);
      const auto step = [&] {
        Scene scene(settings);
        scene.add(sheet);
        scene.set_positions(scene.add(sheet), moved(sheet->rest(), {0, 0, gap}));
        return scene.step();
      };
      settings.max_contacts = settings.max_contacts_per_pair = std::nullopt;
      const ReportHandle whole = step();
      REQUIRE(whole->contacts().size() > 50);
      for (const std::size_t limit : {std::size_t{1}, std::size_t{50}, std::size_t{3000}}) {
        settings.max_contacts_per_pair = limit;
        compare(*step(), *whole, {detail, {}, limit});
        std::swap(settings.max_contacts, settings.max_contacts_per_pair);
        compare(*step(), *whole, {detail, limit, {}});
        std::swap(settings.max_contacts, settings.max_contacts_per_pair);
      }
    }
}

TEST_CASE("limits: of large pairs, that are cut into slices") {
  const auto ball = mesh_of(models::sphere(80, 56));
  ObjectSettings object;
  for (const ContactDetail detail : listed_details) {
    SceneSettings settings = settings_of(0.1, 0.2, detail);
    object.solid = detail == ContactDetail::nearest;
    const auto step = [&] {
      Scene scene(settings);
      scene.add(ball, object);
      const ObjectId other = scene.add(ball, object);
      std::vector<ReportHandle> reports;
      for (int frame = 0; frame < 3; ++frame) {
        scene.set_positions(other, moved(ball->rest(), {1.9 + 0.01 * frame, 0.01, 0.02}));
        reports.push_back(scene.step());
      }
      return reports;
    };
    settings.threads = 2;
    const auto whole = step();
    settings.max_contacts_per_pair = 200;
    for (const unsigned threads : {1U, 2U}) {
      settings.threads = threads;
      const auto limited = step();
      for (std::size_t frame = 0; frame < limited.size(); ++frame)
        CHECK(compare(*limited[frame], *whole[frame], {detail, {}, 200}) ==
              (detail == ContactDetail::regions ? 0U : 1U));
    }
  }
}

TEST_CASE("limits: pairs that do not move get what others leave") {
  SceneSettings settings = settings_of(0.5, 4);
  const auto sheet = mesh_of(models::sheet(6, 6, 1, 1));
  const std::size_t limit = 30;
  const auto play = [&](Limit of_all) {
    settings.max_contacts = of_all;
    Scene scene(settings);
    std::vector<ObjectId> ids;
    for (int i = 0; i < 4; ++i) ids.push_back(scene.add(sheet));
    std::vector<ReportHandle> reports;
    for (int frame = 0; frame < 9; ++frame) {
      // Two far from the other two. The second pair is nearer in some frames and away in others.
      if (frame == 0) {
        scene.set_positions(ids[1], moved(sheet->rest(), {0, 0, 0.25}));
        scene.set_positions(ids[2], moved(sheet->rest(), {9, 0, 0}));
      }
      if (frame % 3 != 2)
        scene.set_positions(ids[3], moved(sheet->rest(), {9, 0, frame % 3 == 0 ? 0.125 : 3.0}));
      reports.push_back(scene.step());
    }
    return reports;
  };
  const auto whole = play({});
  const auto limited = play(limit);
  std::size_t cut = 0;
  for (std::size_t frame = 0; frame < whole.size(); ++frame) {
    INFO("frame " << frame);
    cut += compare(*limited[frame], *whole[frame], {settings.detail, limit, {}});
    CHECK(limited[frame]->contacts().size() == std::min(limit, whole[frame]->contacts().size()));
  }
  CHECK(cut > 9);
}

TEST_CASE("limits: of solids in each other the deepest are kept, and edges that pierce last") {
  const std::array meshes{mesh_of(models::sphere(12, 8)), mesh_of(models::box({1.4, 1.1, 0.9})),
                          mesh_of(models::sphere(9, 6, models::Faces::quads)),
                          mesh_of(models::sheet(7, 7, 3, 3))};
  constexpr std::size_t frames = 6;
  SceneSettings settings = settings_of(0.05, 0.1, ContactDetail::nearest);
  const auto play = [&] {
    Scene scene(settings);
    std::vector<ObjectId> ids;
    for (std::size_t i = 0; i < 6; ++i) {
      ObjectSettings object = motion_of(Motion::rigid);
      object.solid = i % 4 != 3;
      ids.push_back(scene.add(meshes[i % meshes.size()], object));
    }
    std::vector<ReportHandle> reports;
    for (std::size_t frame = 0; frame < frames; ++frame) {
      for (std::size_t i = 0; i < ids.size(); ++i) {
        const double time = 0.8 * static_cast<double>(i) + 0.3 * static_cast<double>(frame);
        Eigen::Isometry3d pose(Eigen::AngleAxisd(time, Eigen::Vector3d(1, std::sin(time), 2).normalized()));
        pose.translation() =
            0.7 * Eigen::Vector3d(std::sin(time), std::cos(1.7 * time), std::sin(0.6 * time));
        scene.set_pose(ids[i], pose);
      }
      reports.push_back(scene.step());
    }
    return reports;
  };
  const auto whole = play();
  std::size_t deep = 0;
  for (const ReportHandle& report : whole)
    for (const Contact& contact : report->contacts()) deep += contact.separation() < -0.3 ? 1U : 0U;
  CHECK(deep > 20);
  std::size_t cut = 0;
  for (const auto& [of_all, of_pair] : {std::pair<Limit, Limit>(std::nullopt, 1),
                                        {std::nullopt, 2},
                                        {std::nullopt, 30},
                                        {1, std::nullopt},
                                        {50, std::nullopt},
                                        {60, 20}})
    for (const unsigned threads : {1U, 3U}) {
      settings.max_contacts = of_all;
      settings.max_contacts_per_pair = of_pair;
      settings.threads = threads;
      const auto limited = play();
      for (std::size_t frame = 0; frame < frames; ++frame)
        cut += compare(*limited[frame], *whole[frame], {settings.detail, of_all, of_pair});
    }
  CHECK(cut > 100);
}

TEST_CASE("limits: a corner in the ground is listed before the edges that pierce it") {
  SceneSettings settings = settings_of(0.02, 0.02, ContactDetail::nearest);
  ObjectSettings solid;
  solid.solid = true;
  for (const std::size_t limit : {std::size_t{1}, std::size_t{2}, std::size_t{3}})
    for (const bool of_all : {false, true}) {
      settings.max_contacts = of_all ? Limit(limit) : Limit();
      settings.max_contacts_per_pair = of_all ? Limit() : Limit(limit);
      Scene scene(settings);
      scene.add(mesh_of(models::box({4, 4, 1})), solid);
      solid.motion = Motion::rigid;
      const ObjectId crate = scene.add(mesh_of(models::box({1, 1, 1})), solid);
      Eigen::Isometry3d pose(Eigen::Translation3d(0.1, 0.2, 1.25) *
                             Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 0.8, 0).normalized()));
      scene.set_pose(crate, pose);
      const ReportHandle report = scene.step();
      REQUIRE(report->contacts().size() == limit);
      CHECK(report->contacts()[0].kind == ContactKind::VF);
      CHECK(report->contacts()[0].separation() < -0.1);
      CHECK(report->pairs()[0].contacts_cut);
    }
}

TEST_CASE("limits: of no contacts are refused") {
  SceneSettings settings = settings_of(0.5, 4);
  settings.max_contacts = 0;
  CHECK_THROWS_AS(Scene(settings), Error);
  settings.max_contacts.reset();
  settings.max_contacts_per_pair = 0;
  CHECK_THROWS_AS(Scene(settings), Error);
}

}  // namespace graze::tests
