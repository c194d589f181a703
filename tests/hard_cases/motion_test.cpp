// Coherence is never fooled: whatever moved however, a report is that of a scene built afresh.

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "hard_cases/random_motion.hpp"
#include "hard_cases/scene_comparison.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"

namespace graze::tests {
namespace {

/// Two objects by their indices in the order of addition.
using IndexPair = std::pair<std::size_t, std::size_t>;

bool is_in_contact(const PairReport& row) {
  return row.phase == PairPhase::began || row.phase == PairPhase::touching;
}

/// Whether the pair ended because one of its objects was removed.
bool is_gone(const PairReport& row, const std::vector<ObjectId>& ids) {
  return std::find(ids.begin(), ids.end(), row.a) == ids.end() ||
         std::find(ids.begin(), ids.end(), row.b) == ids.end();
}

/// Every bit of each row and its contacts but for ids, and of the phase only whether it is a contact.
std::map<IndexPair, std::string> rows_by_indices(const FrameReport& report,
                                                 const std::vector<ObjectId>& ids) {
  std::map<IndexPair, std::string> rows;
  const auto index_of = [&](ObjectId id) {
    return static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
  };
  for (PairReport row : report.pairs()) {
    if (is_gone(row, ids)) continue;
    const IndexPair indices(index_of(row.a), index_of(row.b));
    row.a = row.b = {};
    row.phase = is_in_contact(row) ? PairPhase::touching : PairPhase::near;
    rows[indices] = text_of(report, row);
  }
  return rows;
}

/// The ids of a scene made afresh.
std::vector<ObjectId> fresh_ids(std::size_t count) {
  std::vector<ObjectId> ids;
  for (std::uint32_t i = 0; i < count; ++i) ids.push_back({i, 1});
  return ids;
}

/// Follows one random motion and compares each report with that of a scene built afresh.
class Judge {
 public:
  Judge(std::uint64_t seed, const SceneSettings& settings) : motion_(seed, settings) {}

  /// Empty while all is well.
  std::string step() {
    const ReportHandle report = motion_.step();
    const ReportHandle afresh = motion_.built_afresh();
    ids_ = motion_.ids();
    if (!report->diagnostics().empty()) return report->diagnostics()[0].message;
    std::string problem = inconsistency_of(*report);
    if (problem.empty()) problem = rows_differ(*report, *afresh);
    if (problem.empty()) problem = phases_differ(*report, *afresh);
    return problem;
  }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t contacts() const { return contacts_; }
  [[nodiscard]] const std::set<PairPhase>& phases() const { return phases_; }

 private:
  std::string rows_differ(const FrameReport& report, const FrameReport& afresh) {
    const auto found = rows_by_indices(report, ids_);
    const auto expected = rows_by_indices(afresh, fresh_ids(ids_.size()));
    for (const auto& [indices, text] : expected) {
      const auto row = found.find(indices);
      if (row == found.end()) return "missing: " + text + shapes_of(indices);
      if (row->second != text) return row->second + "\ninstead of\n" + text + shapes_of(indices);
      ++rows_;
    }
    contacts_ += afresh.contacts().size();
    return {};
  }

  /// Rows beyond those of the other scene have just ended, and every phase is the one that follows.
  std::string phases_differ(const FrameReport& report, const FrameReport& afresh) {
    std::set<std::pair<ObjectId, ObjectId>> now;
    for (const PairReport& row : afresh.pairs())
      if (is_in_contact(row)) now.emplace(ids_[row.a.index], ids_[row.b.index]);
    const auto expected = rows_by_indices(afresh, fresh_ids(ids_.size()));
    const auto found = rows_by_indices(report, ids_);
    auto place = found.begin();
    for (const PairReport& row : report.pairs()) {
      const bool is = now.contains({row.a, row.b});
      const bool was = before_.contains({row.a, row.b});
      const PairPhase phase =
          is ? (was ? PairPhase::touching : PairPhase::began) : (was ? PairPhase::ended : PairPhase::near);
      phases_.insert(row.phase);
      if (is_gone(row, ids_)) {
        if (row.phase != PairPhase::ended || !was)
          return "a row of an object that is gone: " + text_of(report, row);
        continue;
      }
      if (row.phase != phase) return "phase " + std::string(to_string(row.phase)) + shapes_of(place->first);
      if (!expected.contains(place->first) && phase != PairPhase::ended)
        return "too much: " + place->second + shapes_of(place->first);
      ++place;
    }
    before_ = now;
    return {};
  }

  [[nodiscard]] std::string shapes_of(const IndexPair& indices) const {
    return "\nobjects " + std::to_string(indices.first) + " and " + std::to_string(indices.second) + "\n" +
           text_of(motion_.shape(ids_[indices.first])) + text_of(motion_.shape(ids_[indices.second]));
  }

  RandomMotion motion_;
  std::vector<ObjectId> ids_;
  std::set<std::pair<ObjectId, ObjectId>> before_;
  std::set<PairPhase> phases_;
  std::size_t rows_ = 0;
  std::size_t contacts_ = 0;
};

/// Four shapes on a grid of quarters or eighths, where distances tie and features are parallel. They rest, or
/// move by steps of the grid, by small exact steps, or by something small in between.
class GridMotion {
 public:
  explicit GridMotion(std::uint64_t seed) : random_(seed) { seed % 3 == 0 ? add_larger() : add_small(seed); }

  void move() {
    for (Body& body : bodies_) {
      const std::uint32_t kind = random_.below(6);
      if (kind < 2) continue;
      const double size = kind == 2 ? 0.25 : std::ldexp(1.0, -static_cast<int>(random_.below(16)) - 4);
      const auto step = [&] {
        return kind < 5 ? size * (static_cast<double>(random_.below(3)) - 1) : random_.between(-size, size);
      };
      const double x = step();
      const double y = step();
      body.now = mapped(body.now, 1, {x, y, step()});
    }
  }
  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }
  [[nodiscard]] double threshold() const { return threshold_; }

 private:
  /// Adds two pairs of random bodies of up to twelve faces each.
  void add_small(std::uint64_t seed) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      const oracle::RandomScene given = oracle::random_scene(2 * (2 * seed + i) + 1);
      bodies_.insert(bodies_.end(), {given.a, given.b});
      threshold_ = std::max(threshold_, given.threshold);
    }
  }
  /// Adds four bodies of several regions. Some of their faces lose their area to the grid of eighths.
  void add_larger() {
    const std::array shapes{shape_of(models::sheet(12, 9, 2, 2)), shape_of(models::sphere(16, 12)),
                            shape_of(models::torus(16, 10, 0.75, 0.3)), shape_of(models::box({1, 1, 1}))};
    for (int i = 0; i < 4; ++i) {
      oracle::Shape shape = shapes[random_.below(4)];
      const Eigen::Vector3d place = random_.vector(-1, 1);
      for (Eigen::Vector3d& position : shape.positions)
        position = ((position + place) * 8).array().round().matrix() / 8;
      bodies_.emplace_back(shape);
    }
    threshold_ = random_.chance(0.5) ? 0.125 : 0.05;
  }

  oracle::Random random_;
  std::vector<Body> bodies_;
  double threshold_ = 0;
};

}  // namespace

/// Motions that are compared with scenes built afresh, for each detail.
constexpr std::uint64_t motions = 2 * repeats(4);

static_assert(all_details.size() == 6, "add the number of a new detail to each list of numbers here");

TEMPLATE_TEST_CASE_SIG(
    "teleport, tunnelling, collapse and back, inside out: as built afresh, at random, detail", "",
    ((int number), number), 0, 1, 2, 3, 4, 5) {
  const auto detail = static_cast<ContactDetail>(number);
  std::size_t rows = 0;
  std::size_t contacts = 0;
  std::size_t frames = 0;
  std::set<PairPhase> phases;
  for (std::uint64_t seed = 0; seed < motions; ++seed) {
    SceneSettings settings = settings_of(0.05, seed % 3 == 0 ? infinity : 0.3, detail);
    settings.threads = 1 + static_cast<unsigned>(seed % 2);
    Judge judge(seed, settings);
    for (int frame = 0; frame < 80; ++frame) {
      const std::string problem = judge.step();
      INFO("seed " << seed << ", frame " << frame);
      REQUIRE(problem == "");
      ++frames;
    }
    rows += judge.rows();
    contacts += judge.contacts();
    phases.insert(judge.phases().begin(), judge.phases().end());
  }
  CHECK(phases.size() == 4);
  CHECK(rows > 3 * frames);
  if (detail != ContactDetail::none) CHECK(contacts > frames / 10);
  std::cout << "compared " << frames << " frames of random motion, " << rows << " pairs, " << contacts
            << " contacts\n";
}

TEST_CASE("teleport, tunnelling, collapse to a point and back, inside out: each by itself") {
  const oracle::Shape ball = shape_of(models::sphere(16, 9));
  const oracle::Shape other = mapped(turned(ball, 1), 1, {1.9, 0.1, 0});
  const auto at = [&](const Eigen::Vector3d& place, double size = 1) {
    return Body(ball, mapped(ball, size, place));
  };
  using Path = std::vector<Body>;
  const std::vector<std::pair<const char*, Path>> paths{
      {"teleport",
       {at({0, 0, 0}), at({1e6, 0, 0}), at({0, 0, 0}), at({0.5, 0, 0}), at({-1e6, 1, 1}), at({0, 0, 0})}},
      {"tunnelling",
       {at({-3, 0, 0}), at({0, 0, 0}), at({4, 0, 0}), at({0, 0, 0}), at({3.8, 0.1, 0}), at({-3, 0, 0})}},
      {"collapse",
       {at({0, 0, 0}), at({0, 0, 0}, 0), at({1, 0, 0}, 0), at({0, 0, 0}), at({0, 0, 0}, 1e-12),
        at({0, 0, 0})}},
      {"inside out",
       {at({0, 0, 0}), at({0, 0, 0}, -1), at({0, 0, 0}), at({0.2, 0, 0}, -1), at({0, 0, 0}, -1),
        at({0, 0, 0})}},
      {"rest", {at({0, 0, 0}), at({0, 0, 0}), at({0, 0, 0}), at({0, 0, 0}), at({0, 0, 1e-9}), at({0, 0, 0})}},
  };
  std::size_t compared = 0;
  for (const auto& [name, path] : paths)
    for (const ContactDetail detail : all_details) {
      BodyScene scene({ball, other}, settings_of(0.1, 5, detail));
      for (std::size_t frame = 0; frame < path.size(); ++frame) {
        INFO(name << ", detail " << static_cast<int>(detail) << ", frame " << frame);
        const ReportHandle report = scene.step({path[frame], other});
        BodyScene fresh({ball, other}, settings_of(0.1, 5, detail));
        const ReportHandle afresh = fresh.step({path[frame], other});
        CHECK(timeless_rows_of(*report, 5) == timeless_rows_of(*afresh, 5));
        ++compared;
      }
    }
  std::cout << "compared " << compared << " frames of single motions\n";
}

TEMPLATE_TEST_CASE_SIG("shapes on a grid that part and meet by little: as built afresh, detail", "",
                       ((int number), number), 0, 1, 2, 3, 4, 5) {
  const auto detail = static_cast<ContactDetail>(number);
  std::size_t rows = 0;
  for (std::uint64_t seed = 0; seed < 12 * motions; ++seed) {
    GridMotion motion(seed);
    const double range = seed % 2 == 0 ? 1 : 0;
    const SceneSettings settings = settings_of(seed % 4 < 2 ? motion.threshold() : 0, range, detail);
    BodyScene scene(motion.bodies(), settings);
    for (int frame = 0; frame < 12; ++frame) {
      const ReportHandle report = scene.step(motion.bodies());
      BodyScene fresh(motion.bodies(), settings);
      const ReportHandle afresh = fresh.step(motion.bodies());
      INFO("seed " << seed << ", frame " << frame);
      REQUIRE(timeless_rows_of(*report, range) == timeless_rows_of(*afresh, range));
      rows += afresh->pairs().size();
      motion.move();
    }
  }
  CHECK(rows > 144 * motions);
  std::cout << "compared " << rows << " pairs on a grid\n";
}

}  // namespace graze::tests
