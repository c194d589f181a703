// Which contacts carry a pair: the choice beside a brute force that is written another way, and what it is
// for.

#include "core/pair/carrying.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Key = std::tuple<ContactKind, Feature, Feature>;

Key key_of(const Contact& contact) {
  return {contact.kind, contact.feature_a, contact.feature_b};
}

void sort_by_keys(std::vector<Contact>& contacts) {
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& left, const Contact& right) { return key_of(left) < key_of(right); });
}

Vector3d middle_of(const Contact& contact) {
  return 0.5 * (contact.point_a + contact.point_b);
}

bool pierces(const Contact& contact) {
  return contact.kind == ContactKind::EF && contact.distance == 0;
}

/// A vertex of b at a place above a face of a, or below it if the separation is negative.
Contact vertex_on_face(std::uint32_t vertex, const Vector3d& place, double separation,
                       const Vector3d& push = Vector3d::UnitZ()) {
  Contact contact;
  contact.kind = ContactKind::VF;
  contact.feature_a = {FeatureKind::face, 0};
  contact.feature_b = {FeatureKind::vertex, vertex};
  contact.point_a = place - 0.5 * separation * push;
  contact.point_b = place + 0.5 * separation * push;
  contact.distance = std::abs(separation);
  contact.normal = separation < 0 ? Vector3d(-push) : push;
  contact.side_a = separation < 0 ? Side::back : Side::front;
  return contact;
}

Contact piercing(std::uint32_t edge) {
  Contact contact;
  contact.kind = ContactKind::EF;
  contact.feature_a = {FeatureKind::face, 0};
  contact.feature_b = {FeatureKind::edge, edge};
  contact.normal = Vector3d::UnitZ();
  return contact;
}

// ---- The brute force

bool has_common_vertex(const Contact& left, const Contact& right) {
  return (left.feature_a.kind == FeatureKind::vertex && left.feature_a == right.feature_a) ||
         (left.feature_b.kind == FeatureKind::vertex && left.feature_b == right.feature_b);
}

/// The keys of the contacts that the last report lists, by the features of now.
std::set<Key> listed_now(const std::vector<Contact>& all, const std::vector<Contact>& last) {
  std::set<Key> listed;
  std::vector<Contact> lost;
  for (const Contact& before : last) {
    if (pierces(before)) continue;
    const bool is_there = std::any_of(all.begin(), all.end(),
                                      [&](const Contact& now) { return key_of(now) == key_of(before); });
    if (is_there)
      listed.insert(key_of(before));
    else
      lost.push_back(before);
  }
  for (const Contact& before : lost) {
    std::vector<std::pair<double, Key>> near;
    for (const Contact& now : all)
      if (!pierces(now) && has_common_vertex(before, now) && !listed.contains(key_of(now)))
        near.emplace_back((middle_of(now) - middle_of(before)).squaredNorm(), key_of(now));
    if (!near.empty()) listed.insert(std::min_element(near.begin(), near.end())->second);
  }
  return listed;
}

/// The distance of a point to the convex hull of others: the widest gap that a line between them can have.
/// The line is square to the way from one of the others, or along two of them.
double overhang_of(const Vector2d& point, const std::vector<Vector2d>& others) {
  std::vector<Vector2d> directions;
  for (const Vector2d& other : others) {
    directions.emplace_back(point - other);
    for (const Vector2d& second : others)
      directions.emplace_back(second.y() - other.y(), other.x() - second.x());
  }
  double widest = 0;
  for (const Vector2d& direction : directions) {
    if (direction.norm() == 0) continue;
    double gap = std::numeric_limits<double>::infinity();
    for (const Vector2d& other : others) gap = std::min(gap, direction.normalized().dot(point - other));
    widest = std::max(widest, gap);
  }
  return widest;
}

double nearest_distance(const Vector2d& point, const std::vector<Vector2d>& others) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector2d& other : others) least = std::min(least, (point - other).norm());
  return least;
}

bool push_alike(const Contact& left, const Contact& right) {
  return left.push().dot(right.push()) > 0.898794;
}

/// Of those that were listed and are deep enough, or of all, the one that is deepest. Of those that are about
/// as deep, the one that is farthest from the middle of all.
template <typename WasListed>
Contact leader_of(const std::vector<Contact>& all, const WasListed& was_listed, double band) {
  const auto deepest_of = [](const std::vector<Contact>& some) {
    double deepest = std::numeric_limits<double>::infinity();
    for (const Contact& each : some) deepest = std::min(deepest, each.separation());
    return deepest;
  };
  Vector3d middle = Vector3d::Zero();
  for (const Contact& each : all) middle += middle_of(each) / static_cast<double>(all.size());
  std::vector<Contact> leaders;
  for (const Contact& each : all)
    if (was_listed(each) && each.separation() <= deepest_of(all) + band / 4) leaders.push_back(each);
  if (leaders.empty()) leaders = all;
  const double least = deepest_of(leaders);
  std::erase_if(leaders, [&](const Contact& each) { return each.separation() > least + band / 64; });
  return *std::max_element(leaders.begin(), leaders.end(), [&](const auto& one, const auto& other) {
    return (middle_of(one) - middle).norm() < (middle_of(other) - middle).norm();
  });
}

/// What docs/answers.md says, from the front.
std::vector<Contact> chosen_by_brute_force(const std::vector<Contact>& all, const std::vector<Contact>& last,
                                           const CarryingRule& rule) {
  std::vector<Contact> left;
  std::copy_if(all.begin(), all.end(), std::back_inserter(left),
               [](const Contact& each) { return !pierces(each); });
  if (left.empty())
    return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(rule.most, all.size()))};
  const std::set<Key> listed = listed_now(all, last);
  const auto was_listed = [&](const Contact& each) { return listed.contains(key_of(each)); };

  const double deepest = std::min_element(left.begin(), left.end(), [](const auto& one, const auto& other) {
                           return one.separation() < other.separation();
                         })->separation();
  std::erase_if(left, [&](const Contact& each) { return each.separation() > deepest + rule.band; });
  const Contact leader = leader_of(left, was_listed, rule.band);
  std::vector<Contact> others;
  std::vector<Contact> beside = left;
  std::erase_if(beside, [&](const Contact& each) { return push_alike(each, leader); });
  while (!beside.empty() && 4 + 2 * others.size() + 2 <= rule.most) {
    others.push_back(leader_of(beside, was_listed, rule.band));
    std::erase_if(beside, [&](const Contact& each) { return push_alike(each, others.back()); });
  }
  std::erase_if(left, [&](const Contact& each) { return !push_alike(each, leader); });

  const Eigen::Quaterniond upright = Eigen::Quaterniond::FromTwoVectors(leader.push(), Vector3d::UnitZ());
  const auto place_of = [&](const Contact& each) { return Vector2d((upright * middle_of(each)).head<2>()); };
  const auto share_of = [&](const Contact& each) {
    return rule.band == 0 ? 1 : 1 - (each.separation() - deepest) / rule.band;
  };
  std::vector<Contact> chosen{leader};
  std::vector<Vector2d> places{place_of(leader)};
  std::erase_if(left, [&](const Contact& each) { return key_of(each) == key_of(leader); });
  double outside = 0;
  bool fills = false;
  while (!left.empty() && chosen.size() + others.size() < rule.most) {
    const auto distance = [&](const Contact& each) {
      return fills ? nearest_distance(place_of(each), places) : overhang_of(place_of(each), places);
    };
    const auto gain = [&](const Contact& each) { return std::pow(share_of(each), 4) * distance(each); };
    const auto gains_less = [&](const Contact& one, const Contact& other) { return gain(one) < gain(other); };
    auto next = std::max_element(left.begin(), left.end(), gains_less);
    std::vector<Contact> stay;
    std::copy_if(left.begin(), left.end(), std::back_inserter(stay), was_listed);
    const double to_stay = 0.6 * std::max(gain(*next), fills ? 0 : outside);
    const bool falls_short = gain(*next) < outside;
    if (const auto best = std::max_element(stay.begin(), stay.end(), gains_less);
        best != stay.end() && gain(*best) >= to_stay) {
      next = std::find_if(left.begin(), left.end(),
                          [&](const Contact& each) { return key_of(each) == key_of(*best); });
    } else if (!fills && falls_short) {
      fills = true;
      continue;
    }
    if (chosen.size() == 1) outside = distance(*next) / 16;
    places.push_back(place_of(*next));
    chosen.push_back(*next);
    left.erase(next);
  }
  chosen.insert(chosen.end(), others.begin(), others.end());
  sort_by_keys(chosen);
  return chosen;
}

// ---- What is given to both

/// Contacts on and about a ground that slopes a little, deep ones and others, of every kind that there is.
std::vector<Contact> random_contacts(std::mt19937& random, std::size_t count) {
  const auto below = [&](std::uint32_t most) { return static_cast<std::uint32_t>(random() % most); };
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Contact> contacts;
  std::set<Key> keys;
  while (contacts.size() < count) {
    const Vector3d push =
        (Vector3d::UnitZ() + between(0, 0.6) * Vector3d(between(-1, 1), between(-1, 1), 0)).normalized();
    Contact contact = vertex_on_face(below(12), {between(-1, 1), between(-0.4, 0.4), between(-0.01, 0.01)},
                                     between(-0.01, 0.02), below(8) == 0 ? Vector3d::UnitX() : push);
    switch (below(5)) {
      case 0:
        contact = piercing(below(20));
        break;
      case 1:
        contact.kind = ContactKind::EE;
        contact.feature_a = {FeatureKind::edge, below(9)};
        contact.feature_b = {FeatureKind::edge, below(9)};
        contact.sunk = contact.side_a == Side::back;
        break;
      case 2:
        contact.feature_a = {FeatureKind::vertex, below(12)};
        contact.feature_b = {FeatureKind::face, below(3)};
        contact.side_b = contact.side_a;
        break;
      default:
        contact.feature_a.index = below(3);
    }
    if (keys.insert(key_of(contact)).second) contacts.push_back(contact);
  }
  sort_by_keys(contacts);
  return contacts;
}

std::vector<Key> keys_of(const std::vector<Contact>& contacts) {
  std::vector<Key> keys;
  for (const Contact& contact : contacts) keys.push_back(key_of(contact));
  return keys;
}

std::vector<Contact> chosen_of(std::vector<Contact> contacts, const std::vector<Contact>& last,
                               const CarryingRule& rule) {
  CarryingChoice().choose(contacts, last, rule);
  return contacts;
}

/// The area of the convex hull of the places of contacts, seen from above.
double area_of(const std::vector<Contact>& contacts) {
  double area = 0;  // of the largest triangles that four or fewer places make
  for (const Contact& a : contacts)
    for (const Contact& b : contacts)
      for (const Contact& c : contacts)
        for (const Contact& d : contacts) {
          const Vector3d first = middle_of(c) - middle_of(a);
          const Vector3d second = middle_of(d) - middle_of(b);
          area = std::max(area, 0.5 * std::abs(first.x() * second.y() - first.y() * second.x()));
        }
  return area;
}

/// The corners of a box that lies flat, and the corners of the grid below it, all as deep to within rounding.
std::vector<Contact> lying_box(double length, double width, double cell, std::mt19937& random) {
  std::vector<Contact> contacts;
  std::uint32_t vertex = 0;
  const auto noise = [&] { return 1e-17 * static_cast<double>(random() % 64); };
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      contacts.push_back(vertex_on_face(vertex++, {x * length / 2, y * width / 2, 0}, noise()));
  std::uint32_t of_grid = 0;
  for (double x = -length / 2 + cell / 3; x < length / 2; x += cell)
    for (double y = -width / 2 + cell / 3; y < width / 2; y += cell) {
      contacts.push_back(vertex_on_face(0, {x, y, 0}, noise()));
      contacts.back().feature_a = {FeatureKind::vertex, of_grid++};
      contacts.back().feature_b = {FeatureKind::face, 0};
    }
  sort_by_keys(contacts);
  return contacts;
}

}  // namespace

TEST_CASE("carrying: the choice is that of brute force, from step to step") {
  std::mt19937 random(7);
  CarryingChoice choice;
  std::size_t had_to_choose = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::size_t count = 1 + random() % 40;
    std::vector<Contact> last = random_contacts(random, random() % 9);
    const CarryingRule rule{1 + random() % 9,
                            round % 16 == 0 ? 0 : 0.001 * static_cast<double>(random() % 30)};
    for (int step = 0; step < 3; ++step) {
      std::vector<Contact> contacts = random_contacts(random, count);
      const std::vector<Contact> expected = chosen_by_brute_force(contacts, last, rule);
      const std::vector<Contact> given = contacts;
      const bool has_more = choice.choose(contacts, last, rule);
      INFO("round " << round << ", step " << step);
      REQUIRE(keys_of(contacts) == keys_of(expected));
      CHECK(contacts.size() <= rule.most);
      std::vector<Contact> one_more = given;
      choice.choose(one_more, last, {rule.most + 1, rule.band});
      if (!has_more) CHECK(keys_of(one_more) == keys_of(contacts));
      had_to_choose += given.size() > contacts.size() ? 1U : 0U;
      last = contacts;
    }
  }
  CHECK(had_to_choose > 3000);
}

TEST_CASE("carrying: four contacts of a box that lies flat span it, whatever was listed before") {
  std::mt19937 random(3);
  for (const auto& [length, width] : {std::pair{1.0, 1.0}, {1.0, 0.12}, {2.0, 0.5}})
    for (int round = 0; round < 20; ++round) {
      const std::vector<Contact> all = lying_box(length, width, 0.05, random);
      CHECK(area_of(chosen_of(all, {}, {4, 0.02})) > 0.999 * length * width);
      // A box that comes down on a corner has listed what is near that corner.
      std::vector<Contact> last;
      for (const Contact& contact : all)
        if ((middle_of(contact) - middle_of(all[0])).norm() < 0.12) last.push_back(contact);
      for (int step = 0; step < 3; ++step) last = chosen_of(all, last, {4, 0.02});
      CHECK(last.size() == 4);
      CHECK(area_of(last) > 0.75 * length * width);
    }
}

TEST_CASE("carrying: a list stays while depths tremble by a twentieth of the band") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> tremble(0, 0.001);
  const std::vector<Contact> rest = lying_box(1, 0.6, 0.05, random);
  for (const std::size_t most : {1U, 3U, 4U, 6U, 8U, 13U}) {
    const std::vector<Contact> first = chosen_of(rest, {}, {most, 0.02});
    std::vector<Contact> last = first;
    for (int step = 0; step < 100; ++step) {
      std::vector<Contact> all = rest;
      for (Contact& contact : all) contact.distance = tremble(random);
      last = chosen_of(all, last, {most, 0.02});
      INFO(most << " contacts, step " << step);
      CHECK((keys_of(last) == keys_of(first)));
    }
  }
}

TEST_CASE("carrying: what is deeper than the others by the band carries alone, at once") {
  std::mt19937 random(5);
  std::vector<Contact> all = lying_box(1, 1, 0.1, random);
  const std::vector<Contact> last = chosen_of(all, {}, {4, 0.02});
  all[40] = vertex_on_face(99, middle_of(all[40]), -0.021);
  const std::vector<Contact> now = chosen_of(all, last, {4, 0.02});
  REQUIRE(now.size() == 1);
  CHECK(now[0].separation() == -0.021);
  // By less than that but by more than a quarter it leads, and the others stay.
  all[40] = vertex_on_face(99, middle_of(all[40]), -0.006);
  const std::vector<Contact> later = chosen_of(all, last, {5, 0.02});
  REQUIRE(later.size() == 5);
  CHECK(std::any_of(later.begin(), later.end(),
                    [](const Contact& each) { return each.separation() == -0.006; }));
  CHECK(area_of(later) > 0.9);
}

TEST_CASE("carrying: up to four contacts push within 26 degrees of the leader") {
  for (const double degrees : {25.9, 26.1, 90.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vector3d other(std::sin(angle), 0, std::cos(angle));
    const std::vector<Contact> all{
        vertex_on_face(0, {0, 0, 0}, -0.0005), vertex_on_face(1, {1, 0, 0}, 0.0, other),
        vertex_on_face(2, {0, 1, 0}, -0.0002), vertex_on_face(3, {1, 1, 0}, 0.0, other)};
    CHECK(chosen_of(all, {}, {4, 0.02}).size() == (degrees < 26 ? 4 : 2));
    CHECK(keys_of(chosen_of(all, {}, {1, 0.02})) == keys_of({all[0]}));
    // A listed one leads on, though others are deeper by less than a quarter of the band.
    const std::vector<Contact> last{all[1], all[3]};
    const std::vector<Contact> later = chosen_of(all, last, {2, 0.02});
    CHECK(keys_of(later) == keys_of(last));
  }
}

TEST_CASE(
    "carrying: from six contacts on, one of each other direction is among them, and four of the first") {
  std::mt19937 random(8);
  std::vector<Contact> all = lying_box(1, 1, 0.1, random);
  for (std::uint32_t i = 0; i < 5; ++i) {
    all.push_back(vertex_on_face(50 + i, {0.5, 0.1 * i, 0.2}, 0.001 * i, -Vector3d::UnitX()));
    all.push_back(vertex_on_face(70 + i, {0.1 * i, 0.5, 0.2}, 0.001 * i + 0.0005, -Vector3d::UnitY()));
  }
  sort_by_keys(all);
  for (const std::size_t most : {1U, 4U, 5U, 6U, 7U, 8U, 12U}) {
    const std::vector<Contact> chosen = chosen_of(all, {}, {most, 0.02});
    CHECK(chosen.size() == most);
    std::vector<Contact> upward = chosen;
    std::erase_if(upward, [](const Contact& each) { return each.push().z() < 0.9; });
    const std::size_t others = most < 6 ? 0 : most < 8 ? 1 : 2;
    CHECK(upward.size() == most - others);
    if (most >= 4) CHECK(area_of(upward) > 0.9);
    const auto has = [&](std::uint32_t vertex) {
      return std::any_of(chosen.begin(), chosen.end(),
                         [&](const Contact& each) { return each.feature_b.index == vertex; });
    };
    CHECK(has(50) == (others > 0));  // the deepest of each wall
    CHECK(has(70) == (others > 1));
  }
}

TEST_CASE("carrying: edges that pierce are listed only where there is nothing else") {
  std::vector<Contact> all{piercing(1), piercing(4), piercing(7)};
  CHECK(keys_of(chosen_of(all, {}, {2, 0.02})) == keys_of({all[0], all[1]}));
  CHECK(chosen_of(all, {}, {5, 0.02}).size() == 3);
  all.insert(all.begin(), vertex_on_face(0, {0, 0, 0}, 0.015));
  CHECK(keys_of(chosen_of(all, {}, {2, 0.02})) == keys_of({all[0]}));
}

TEST_CASE("carrying: a vertex that comes to another face stays") {
  std::vector<Contact> all{vertex_on_face(0, {0, 0, 0}, 0), vertex_on_face(1, {1, 0, 0}, 0),
                           vertex_on_face(2, {0.8, 0, 0}, 0)};
  std::vector<Contact> last{all[0], all[2]};
  for (Contact& contact : last) contact.feature_a.index = 3;
  CHECK(keys_of(chosen_of(all, last, {2, 0.02})) == keys_of({all[0], all[2]}));
  CHECK(keys_of(chosen_of(all, {}, {2, 0.02})) == keys_of({all[0], all[1]}));
}

}  // namespace graze::tests
