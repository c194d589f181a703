// Gives the same rigid motion of a scene's bodies in each way: `graze_inputs_bench [FRAMES]`. Prints medians
// of a step with the calls before it, on one thread, of scenes like S3 and S5 of `graze_studies bench` in two
// details. Then it prints time and bytes of a mesh of a million vertices. Reports of doubles and of poses are
// compared.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <graze/graze.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "models/models.hpp"
#include "scenes/mesh_of.hpp"
#include "scenes/random.hpp"

namespace {

using namespace graze;  // NOLINT: the vocabulary of this file

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// Bodies that turn and sway, placed by the formula of a pose.
class Bodies {
 public:
  void add(std::shared_ptr<const Mesh> mesh, const Eigen::Vector3d& centre, scenes::Random& random) {
    first_.push_back(doubles_.size());
    doubles_.resize(doubles_.size() + mesh->vertex_count());
    floats_.resize(doubles_.size());
    meshes_.push_back(std::move(mesh));
    paths_.push_back({random.turn(), centre, random.vector(-1, 1).normalized(), random.between(0, 6)});
    poses_.push_back(Eigen::Isometry3d::Identity());
  }
  void place(std::size_t frame) {
    const auto time = static_cast<double>(frame);
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      const Path& path = paths_[i];
      poses_[i].linear() = Eigen::AngleAxisd(0.02 * time, path.axis).toRotationMatrix() * path.turn;
      for (int axis = 0; axis < 3; ++axis)
        poses_[i].translation()[axis] =
            path.centre[axis] + 0.02 * std::sin((0.1 + 0.03 * axis) * time + path.phase + axis);
      place_vertices(i);
    }
  }
  [[nodiscard]] std::size_t size() const { return paths_.size(); }
  [[nodiscard]] const std::shared_ptr<const Mesh>& mesh(std::size_t i) const { return meshes_[i]; }
  [[nodiscard]] std::span<const Eigen::Isometry3d> poses() const { return poses_; }
  [[nodiscard]] PositionView view(std::size_t i, bool in_double) const {
    const std::size_t count = meshes_[i]->vertex_count();
    if (in_double) return PositionView(std::span(doubles_).subspan(first_[i], count));
    return PositionView(std::span(floats_).subspan(first_[i], count));
  }

 private:
  struct Path {
    Eigen::Matrix3d turn;
    Eigen::Vector3d centre, axis;
    double phase;
  };
  void place_vertices(std::size_t i) {
    const auto& m = poses_[i].matrix();
    std::size_t vertex = first_[i];
    for (const Eigen::Vector3d& p : meshes_[i]->rest()) {
      for (int row = 0; row < 3; ++row)
        doubles_[vertex][row] = ((m(row, 0) * p.x() + m(row, 1) * p.y()) + m(row, 2) * p.z()) + m(row, 3);
      floats_[vertex] = doubles_[vertex].cast<float>();
      ++vertex;
    }
  }

  std::vector<std::shared_ptr<const Mesh>> meshes_;
  std::vector<Path> paths_;
  std::vector<std::size_t> first_;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<Eigen::Vector3d> doubles_;
  std::vector<Eigen::Vector3f> floats_;
};

/// 1,000 surfaces of 1,000 vertices, of which 25 pairs touch.
Bodies like_s3() {
  Bodies bodies;
  scenes::Random random(4);
  const auto ball = scenes::mesh_of(models::sphere(40, 25));
  const auto ring = scenes::mesh_of(models::torus(40, 25, 0.7, 0.3));
  for (std::size_t i = 0; i < 1000; ++i) {
    const std::size_t column = i % 10, row = i / 10 % 10, layer = i / 100;
    Eigen::Vector3d centre(static_cast<double>(column), static_cast<double>(row), static_cast<double>(layer));
    centre *= 3.2;
    if (i % 40 == 5) centre.x() += 3.2 - 1.97;
    bodies.add(i % 40 == 5 || i % 40 == 6 || i % 2 == 0 ? ball : ring, centre, random);
  }
  return bodies;
}

/// 10,000 surfaces of 258 vertices on a jittered lattice.
Bodies like_s5() {
  Bodies bodies;
  scenes::Random random(5);
  const auto mesh = scenes::mesh_of(models::sphere(16, 16));
  for (std::size_t i = 0; i < 10'000; ++i) {
    const std::size_t column = i % 22, row = i / 22 % 22, layer = i / 484;
    const Eigen::Vector3d cell(static_cast<double>(column), static_cast<double>(row),
                               static_cast<double>(layer));
    bodies.add(mesh, 2.55 * cell + random.vector(-0.328, 0.328), random);
  }
  return bodies;
}

enum class Way : std::uint8_t { bound, told, copied, posed };

/// A scene that is given all bodies in one way.
class Contender {
 public:
  Contender(const char* name, Way way, bool in_double, const Bodies& bodies, ContactDetail detail)
      : name_(name), way_(way), in_double_(in_double), bodies_(bodies), scene_(settings_of(detail)) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      ObjectSettings settings;
      if (way == Way::posed) settings.motion = Motion::rigid;
      ids_.push_back(scene_.add(bodies.mesh(i), settings));
      if (way == Way::bound || way == Way::told)
        scene_.bind_positions(ids_[i], bodies.view(i, in_double),
                              way == Way::told ? BindPolicy::when_told : BindPolicy::every_step);
    }
  }
  void take_turn(bool is_timed) {
    const double start = cpu_ms();
    if (way_ == Way::told) scene_.positions_changed(ids_);
    if (way_ == Way::copied)
      for (std::size_t i = 0; i < ids_.size(); ++i)
        scene_.set_positions(ids_[i], bodies_.view(i, in_double_));
    if (way_ == Way::posed) scene_.set_poses(ids_, bodies_.poses());
    report_ = scene_.step();
    if (is_timed) times_.push_back(cpu_ms() - start);
  }
  [[nodiscard]] const char* name() const { return name_; }
  [[nodiscard]] bool in_double() const { return in_double_; }
  [[nodiscard]] double ms() const { return median(times_); }
  [[nodiscard]] const FrameReport& report() const { return *report_; }

 private:
  static SceneSettings settings_of(ContactDetail detail) {
    SceneSettings settings;
    settings.contact_distance = settings.range = 0.04;
    settings.detail = detail;
    settings.threads = 1;
    return settings;
  }

  const char* name_;
  Way way_;
  bool in_double_;
  const Bodies& bodies_;
  Scene scene_;
  std::vector<ObjectId> ids_;
  std::vector<double> times_;
  ReportHandle report_;
};

bool is_same(const FrameReport& left, const FrameReport& right) {
  const auto a = left.contacts();
  const auto b = right.contacts();
  return left.pairs().size() == right.pairs().size() &&
         std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Contact& x, const Contact& y) {
           return x.distance == y.distance && x.point_a == y.point_a && x.normal == y.normal;
         });
}

void run(const char* scene, Bodies& bodies, ContactDetail detail, std::size_t frames) {
  constexpr std::size_t warm_up = 4;
  bodies.place(0);
  std::vector<std::unique_ptr<Contender>> all;
  const auto add = [&](const char* name, Way way, bool in_double) {
    all.push_back(std::make_unique<Contender>(name, way, in_double, bodies, detail));
  };
  add("bound, float", Way::bound, false);
  add("told, float", Way::told, false);
  add("copied, float", Way::copied, false);
  add("bound, double", Way::bound, true);
  add("copied, double", Way::copied, true);
  add("posed", Way::posed, true);
  for (std::size_t frame = 0; frame < warm_up + frames; ++frame) {
    if (frame > 0) bodies.place(frame);
    for (std::size_t i = 0; i < all.size(); ++i) all[(frame + i) % all.size()]->take_turn(frame >= warm_up);
    for (const auto& one : all)
      if (!is_same(one->report(), all[one->in_double() ? 3 : 0]->report()))
        throw std::runtime_error(std::string(one->name()) + ": another report than of bound memory");
  }
  for (const auto& one : all)
    std::printf("%s, %s: %-14s %7.2f ms, %.2f x bound floats, %.1f MB\n", scene,
                detail == ContactDetail::vertices ? "A" : "B", one->name(), one->ms(),
                one->ms() / all[0]->ms(),
                1e-6 * static_cast<double>(one->report().statistics().bytes.objects));
}

void time_mesh(const char* name, const models::MeshData& data) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t first = 0;
  for (const std::uint32_t count : data.corner_counts) {
    for (std::uint32_t last = 2; last < count; ++last)
      triangles.push_back({data.corners[first], data.corners[first + last - 1], data.corners[first + last]});
    first += count;
  }
  std::vector<double> times;
  std::size_t bytes = 0;
  for (int turn = 0; turn < 3; ++turn) {
    const double start = cpu_ms();
    const Mesh mesh = Mesh::from_triangles(data.positions, triangles);
    times.push_back(cpu_ms() - start);
    bytes = mesh.byte_count();
  }
  const auto count = static_cast<double>(data.positions.size());
  std::printf("mesh of a %s, %.0f vertices: %.2f us a vertex, %.0f bytes a vertex\n", name, count,
              1e3 * median(times) / count, static_cast<double>(bytes) / count);
}

void run_all(std::size_t frames) {
  Bodies s3 = like_s3();
  Bodies s5 = like_s5();
  for (const ContactDetail detail : {ContactDetail::vertices, ContactDetail::features}) {
    run("S3", s3, detail, frames);
    run("S5", s5, detail, frames);
  }
  time_mesh("sheet", models::sheet(1000, 1000, 1, 1));
  time_mesh("sphere", models::sphere(1000, 1000));
}

}  // namespace

int main(int argument_count, char** arguments) {
  try {
    run_all(argument_count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 8);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
