#include "bench/surface_details.hpp"

#include <algorithm>
#include <graze/graze.hpp>
#include <memory>
#include <span>

#include "bench/contender.hpp"
#include "bench/scenes/wobbling.hpp"
#include "models/models.hpp"
#include "scenes/mesh_of.hpp"

namespace graze::bench {
namespace {

constexpr std::size_t untimed_frames = 3;

/// How far the pushes of a pair's contacts agree: the length of their sum, each weighted by how much is
/// missing to the threshold, in parts of the sum of the lengths. It is 1 where all lead the same way.
double agreement_of(std::span<const Contact> contacts, double threshold) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double lengths = 0;
  for (const Contact& contact : contacts) {
    const double missing = threshold - contact.separation();
    sum += missing * contact.push();
    lengths += missing;
  }
  return lengths > 0 ? sum.norm() / lengths : 1;
}

/// One scene with a detail.
class DetailRun {
 public:
  DetailRun(const MovingWorld& world, ContactDetail detail, bool are_solid)
      : detail_(detail), are_solid_(are_solid), scene_(settings_of(world.world(), detail)) {
    for (std::size_t i = 0; i < world.scene().bodies.size(); ++i) {
      const Body& body = world.scene().bodies[i];
      ObjectSettings settings;
      settings.motion = body.is_fixed ? Motion::fixed : Motion::deformable;
      settings.solid = are_solid;
      const ObjectId id = scene_.add(body.mesh, settings);
      if (!body.is_fixed)
        scene_.bind_positions(id, PositionView(world.world().positions_of(i), body.mesh->vertex_count()));
    }
  }

  void step(bool is_timed) {
    const ReportHandle report = scene_.step();
    if (is_timed) times_.push_back(report->statistics().times.step_ms);
    contacts_ = report->contacts().size();
    pairs_ = 0;
    double agreement = 0;
    for (const PairReport& pair : report->pairs()) {
      if (pair.contact_count < 2) continue;
      ++pairs_;
      agreement += agreement_of(report->contacts(pair), scene_.settings().contact_distance);
    }
    agreement_ = pairs_ > 0 ? agreement / static_cast<double>(pairs_) : 1;
  }
  [[nodiscard]] double median_ms() {
    const auto middle = times_.begin() + static_cast<std::ptrdiff_t>(times_.size() / 2);
    std::nth_element(times_.begin(), middle, times_.end());
    return *middle;
  }
  [[nodiscard]] std::vector<tools::Cell> row(const std::string& scene, double ms_of_features) {
    const double ms = median_ms();
    return {scene,
            std::string(detail_ == ContactDetail::nearest ? "nearest" : "features") +
                (are_solid_ ? ", solids" : ""),
            ms,
            ms / ms_of_features,
            std::uint64_t{contacts_},
            agreement_};
  }

 private:
  static SceneSettings settings_of(const World& world, ContactDetail detail) {
    SceneSettings settings;
    settings.contact_distance = settings.range = world.distance;
    settings.detail = detail;
    settings.threads = 1;
    return settings;
  }

  ContactDetail detail_;
  bool are_solid_;
  Scene scene_;
  std::vector<double> times_;
  std::size_t contacts_ = 0;  ///< of the last frame, as what follows
  std::size_t pairs_ = 0;
  double agreement_ = 1;
};

bool are_closed(const BenchScene& scene) {
  return std::ranges::all_of(scene.bodies, [](const Body& body) {
    const MeshOddities oddities = find_oddities(*body.mesh);
    return oddities.closed_manifold() && oddities.flipped_edges.empty();
  });
}

/// A body that goes up and down by a hundredth, so that each frame has something to do.
Body almost_at_rest(const models::MeshData& data) {
  Body body;
  body.mesh = scenes::mesh_of(data);
  body.place = [points = data.positions](std::size_t frame, std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = static_cast<float>(points[i / 3][static_cast<Eigen::Index>(i % 3)]);
    for (std::size_t i = 2; i < out.size(); i += 3) out[i] += frame % 2 == 0 ? 0.0F : 0.01F;
    return true;
  };
  return body;
}

/// A flat grid of squares of side 1, and a triangle above it that is little larger than one of them.
BenchScene triangle_over_grid() {
  models::MeshData triangle;
  triangle.positions = {{0.3, 0.2, 0.1}, {1.6, 0.525, 0.1}, {0.69, 1.5, 0.1}};
  triangle.add_face({0, 2, 1});  // it faces the grid
  BenchScene scene{"triangle over a flat grid", "", 1.6, 60, {}};
  scene.bodies = {almost_at_rest(models::sheet(20, 20, 20, 20, models::Faces::triangles)),
                  almost_at_rest(triangle)};
  return scene;
}

void add_rows(const BenchScene& scene, std::size_t frames, tools::ResultTable& table) {
  MovingWorld world(scene);
  world.place(0);
  std::vector<std::unique_ptr<DetailRun>> runs;
  for (const bool are_solid : {false, true})
    for (const ContactDetail detail : {ContactDetail::features, ContactDetail::nearest})
      if (!are_solid || are_closed(scene))
        runs.push_back(std::make_unique<DetailRun>(world, detail, are_solid));
  const std::size_t timed = frames == 0 ? scene.frames : frames;
  for (std::size_t frame = 0; frame < untimed_frames + timed; ++frame) {
    world.place(frame);
    for (const auto& run : runs) run->step(frame >= untimed_frames);
  }
  const double ms_of_features = runs.front()->median_ms();
  for (const auto& run : runs) table.rows.push_back(run->row(scene.name, ms_of_features));
}

}  // namespace

tools::ResultTable compare_surface_details(const std::vector<BenchScene>& scenes, std::size_t frames) {
  tools::ResultTable table{"surface_details", "The details features and nearest, on one thread",
                           tools::columns_of({"scene", "detail", "ms: ms a step", "ratio: of features",
                                              "contacts: contacts", "agreement: how far pushes agree"})};
  table.timed = true;
  for (const BenchScene& scene : scenes) add_rows(scene, frames, table);
  add_rows(triangle_over_grid(), frames, table);
  return table;
}

}  // namespace graze::bench
