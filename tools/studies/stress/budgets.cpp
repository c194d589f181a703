#include "stress/budgets.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <graze/graze.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "distribution.hpp"
#include "mean_edge_length.hpp"
#include "models/models.hpp"
#include "output/text.hpp"
#include "output/text_table.hpp"
#include "progress.hpp"
#include "scenes/random.hpp"
#include "stress/clocks.hpp"
#include "stress/details.hpp"

namespace graze::tools {
namespace {

using Positions = std::vector<Eigen::Vector3d>;

constexpr std::array thresholds{0.5, 2.0, 5.0};
constexpr std::array budgets_ms{2, 10};

std::shared_ptr<const Mesh> sphere_of(std::uint32_t segments, std::uint32_t rings) {
  const models::MeshData data = models::sphere(segments, rings);
  return std::make_shared<const Mesh>(Mesh::from_polygons(data.positions, data.corners, data.corner_counts));
}

/// Spheres about one place, each in all others. The first two are copies in one place, where all that is near
/// is at distance 0 and tied. The others are turned. All wobble.
class Cluster {
 public:
  Cluster(std::shared_ptr<const Mesh> mesh, const SceneSettings& settings)
      : mesh_(std::move(mesh)), scene_(settings) {
    scenes::Random random(1);
    for (std::size_t body = 0; body < count; ++body) {
      rest_.emplace_back(mesh_->rest().begin(), mesh_->rest().end());
      if (body > 1) {
        const Eigen::Matrix3d turn = random.turn();
        for (Eigen::Vector3d& point : rest_.back()) point = turn * point;
      }
      now_.push_back(rest_.back());
      scene_.bind_positions(scene_.add(mesh_), now_.back());
    }
  }
  void move(std::size_t frame) {
    for (std::size_t body = 0; body < count; ++body) {
      const double phase =
          0.1 * static_cast<double>(frame) + static_cast<double>(std::max<std::size_t>(1, body));
      const Eigen::Vector3d by =
          0.03 * Eigen::Vector3d(std::sin(phase), std::cos(1.3 * phase), std::sin(0.7 * phase));
      for (std::size_t i = 0; i < now_[body].size(); ++i) now_[body][i] = rest_[body][i] + by;
    }
  }
  Scene& scene() { return scene_; }

 private:
  static constexpr std::size_t count = 5;
  std::shared_ptr<const Mesh> mesh_;
  std::vector<Positions> rest_, now_;
  Scene scene_;
};

struct Measured {
  std::vector<double> wall_ms, cpu_ms;
  std::size_t pairs = 0, complete_pairs = 0, complete_reports = 0, dishonest = 0;
};

bool is_honest(const FrameReport& report) {
  const auto pairs = report.pairs();
  const bool all =
      std::all_of(pairs.begin(), pairs.end(), [](const PairReport& pair) { return pair.complete; });
  return all == report.complete() && std::all_of(pairs.begin(), pairs.end(), [](const PairReport& pair) {
           return pair.complete || (pair.contact_count == 0 && pair.distance.lower <= pair.distance.upper);
         });
}

Measured measure(Cluster& cluster, std::size_t frames) {
  Measured measured;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    cluster.move(frame);
    const auto before = std::chrono::steady_clock::now();
    const double cpu_before = cpu_ns(CLOCK_THREAD_CPUTIME_ID);
    const ReportHandle report = cluster.scene().step();
    const double cpu = cpu_ns(CLOCK_THREAD_CPUTIME_ID) - cpu_before;
    measured.wall_ms.push_back(ns_between(before, std::chrono::steady_clock::now()) / 1e6);
    measured.cpu_ms.push_back(cpu / 1e6);
    for (const PairReport& pair : report->pairs()) measured.complete_pairs += pair.complete ? 1U : 0U;
    measured.pairs += report->pairs().size();
    measured.complete_reports += report->complete() ? 1U : 0U;
    measured.dishonest += is_honest(*report) ? 0U : 1U;
  }
  return measured;
}

}  // namespace

StressResult run_budgets_study(const BudgetsOptions& options) {
  StressResult result;
  result.figures = {{"frames", options.frames}, {"threads", options.threads}, {"unit", "milliseconds"}};
  std::printf("%u threads, %zu steps each; ms\n", options.threads, options.frames);
  const TextTable table = TextTable::of_numbers({"detail", "vertices", "threshold", "budget", "p50", "p99",
                                                 "worst", "cpu p50", "cpu p99", "cpu worst", "pairs done"},
                                                9, 8);
  print(table.head());
  const std::array meshes{sphere_of(42, 19), sphere_of(95, 41)};
  Progress progress("scene", timed_details.size() * thresholds.size() * meshes.size() * budgets_ms.size());
  std::uint64_t done = 0;
  for (const NamedDetail& detail : timed_details)
    for (const auto& mesh : meshes)
      for (const double threshold : thresholds)
        for (const int budget : budgets_ms) {
          SceneSettings settings;
          settings.detail = detail.detail;
          settings.contact_distance = threshold * mean_edge_length(std::span(&mesh, 1));
          settings.range = settings.contact_distance;
          settings.threads = options.threads;
          settings.time_budget = std::chrono::milliseconds(budget);
          Cluster cluster(mesh, settings);
          const Measured measured = measure(cluster, options.frames);
          const Distribution wall(measured.wall_ms), cpu(measured.cpu_ms);
          const double complete =
              static_cast<double>(measured.complete_pairs) / static_cast<double>(measured.pairs);
          print(table.row({detail.name, std::to_string(mesh->vertex_count()), fixed(threshold, 1),
                           std::to_string(budget), fixed(wall.median(), 2), fixed(wall.quantile(0.99), 2),
                           fixed(wall.quantile(1), 2), fixed(cpu.median(), 2), fixed(cpu.quantile(0.99), 2),
                           fixed(cpu.quantile(1), 2), fixed(100 * complete, 0) + " %"}));
          const std::string name = std::string(detail.name) + " of " + std::to_string(mesh->vertex_count()) +
                                   " vertices, threshold " + std::to_string(threshold) + ", budget " +
                                   std::to_string(budget);
          const double allowed = 1.1 * budget + 0.5;
          const double longest = (options.threads == 1 ? cpu : wall).quantile(0.99);
          if (longest > allowed)
            result.violations.push_back(name + ": a step took " + std::to_string(longest) + " ms");
          if (measured.dishonest > 0)
            result.violations.push_back(name + ": " + std::to_string(measured.dishonest) +
                                        " reports said what is not so");
          result.figures["scenes"].push_back({{"detail", detail.name},
                                              {"vertices", mesh->vertex_count()},
                                              {"threshold", threshold},
                                              {"budget", budget},
                                              {"wall", wall.figures()},
                                              {"cpu", cpu.figures()},
                                              {"complete_reports", measured.complete_reports},
                                              {"complete_pairs", complete}});
          progress.at(++done);
        }
  return result;
}

}  // namespace graze::tools
