// The caller's rounding mode and flushing of denormals do not show, and are the caller's again afterwards.

#include <cfenv>
#include <cmath>
#include <cstring>
#include <iostream>
#include <limits>
#include <memory>
#include <thread>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace graze::tests {
namespace {

constexpr std::size_t frame_count = 6;

/// The floating-point mode of the calling thread: its rounding, and on x86 whether denormals are flushed.
struct Mode {
  int rounding = FE_TONEAREST;
  bool flush = false;
  friend bool operator==(const Mode&, const Mode&) = default;
};

#if defined(__SSE__)
constexpr unsigned flush_bits = 0x8040;  // flush to zero, denormals are zero
#endif

Mode current_mode() {
  Mode mode;
  mode.rounding = std::fegetround();
#if defined(__SSE__)
  mode.flush = (_mm_getcsr() & flush_bits) == flush_bits;
#endif
  return mode;
}

/// A mode for as long as this lives.
class ModeScope {
 public:
  explicit ModeScope(const Mode& mode) {
    std::fegetenv(&before_);
    std::fesetround(mode.rounding);
#if defined(__SSE__)
    if (mode.flush) _mm_setcsr(_mm_getcsr() | flush_bits);
#endif
  }
  ~ModeScope() {
    std::fesetenv(&before_);
  }
  ModeScope(const ModeScope&) = delete;
  ModeScope& operator=(const ModeScope&) = delete;

 private:
  std::fenv_t before_{};
};

std::vector<Mode> modes() {
  std::vector<Mode> all;
  for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    all.push_back({rounding, false});
#if defined(__SSE__)
    all.push_back({rounding, true});
#endif
  }
  return all;
}

/// The positions of four bodies in each frame, made before any mode is set. The last body is posed.
struct Prepared {
  std::vector<models::MeshData> meshes = {models::torus(8, 6, 0.5, 0.2), models::sphere(8, 5),
                                          models::sheet(6, 6, 1.5, 1.5), models::box({0.7, 0.5, 0.9})};
  std::array<std::vector<Positions>, frame_count> positions;
  std::array<Eigen::Isometry3d, frame_count> poses;

  Prepared() {
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
      const double time = 0.37 * static_cast<double>(frame);
      for (std::size_t i = 0; i < 3; ++i) {
        const double phase = time + 2.1 * static_cast<double>(i);
        positions[frame].push_back(
            moved(meshes[i].positions,
                  0.6 * Eigen::Vector3d(std::sin(phase), std::cos(2 * phase), std::sin(3 * phase))));
      }
      poses[frame] = Eigen::Isometry3d(Eigen::AngleAxisd(time, Eigen::Vector3d(1, 2, 3).normalized()));
    }
  }
};

/// The reports of a scene that was played in one mode, and whether its calls kept the mode.
struct Played {
  std::vector<ReportHandle> reports;
  bool mode_was_kept = false;  ///< every call left it as it was
};

/// Everything a program does with a scene, all of it in `mode`.
Played play_in_mode(const Prepared& prepared, unsigned threads, const Mode& mode) {
  std::vector<ReportHandle> reports;
  SceneSettings settings = tests::settings_of(0.05, 0.25);
  settings.threads = threads;
  std::vector<Mode> seen;
  {
    const ModeScope scope(mode);
    const auto look = [&] { seen.push_back(current_mode()); };
    Scene scene(settings);
    std::vector<ObjectId> ids;
    for (std::size_t i = 0; i < 4; ++i) {
      ids.push_back(
          scene.add(mesh_of(prepared.meshes[i]), motion_of(i == 3 ? Motion::rigid : Motion::deformable)));
      look();
    }
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
      scene.set_positions(ids[0], prepared.positions[frame][0], 10);
      look();
      scene.bind_positions(ids[1], prepared.positions[frame][1]);
      scene.set_positions(ids[2], prepared.positions[frame][2]);
      scene.set_pose(ids[3], prepared.poses[frame]);
      look();
      reports.push_back(scene.step());
      look();
    }
  }
  return {reports, seen == std::vector(seen.size(), mode)};
}

/// A surface at positions of any kind, between two steps.
template <typename Point>
struct Between {
  std::shared_ptr<const Mesh> mesh;
  std::vector<Point> positions;
};

template <typename Point>
Between<Point> scaled(const models::MeshData& data, double factor, const Eigen::Vector3d& offset) {
  Between<Point> result{mesh_of(data), {}};
  for (const Eigen::Vector3d& position : data.positions)
    result.positions.push_back((factor * (position + offset)).template cast<typename Point::Scalar>());
  return result;
}

void add_to(std::vector<double>& numbers, const ContactGeometry& geometry) {
  for (const Eigen::Vector3d& vector : {geometry.point_a, geometry.point_b, geometry.normal, geometry.push})
    numbers.insert(numbers.end(), vector.data(), vector.data() + 3);
  numbers.insert(numbers.end(),
                 {geometry.distance, geometry.separation, double(geometry.side_a), double(geometry.side_b),
                  double(geometry.sunk), double(geometry.is_interior)});
}

/// All that is computed between two steps, of many pairs of features: positions, both forms of evaluate(),
/// follow() and weights.
template <typename Point>
std::vector<double> computed_between(const Between<Point>& a, const Between<Point>& b) {
  std::vector<double> numbers;
  const PositionView view = a.positions;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const Eigen::Vector3d position = view[i];
    numbers.insert(numbers.end(), position.data(), position.data() + 3);
  }
  const auto feature = [](const Mesh& mesh, std::uint32_t number) -> Feature {
    const std::array counts{mesh.vertex_count(), mesh.edge_count(), mesh.face_count()};
    return {static_cast<FeatureKind>(number % 3), number * 7 % counts[number % 3]};
  };
  Contact contact;
  contact.normal = {0, 0, 1};
  for (std::uint32_t i = 0; i < 30; ++i)
    for (std::uint32_t j = 0; j < 30; ++j) {
      contact.feature_a = feature(*a.mesh, i);
      contact.feature_b = feature(*b.mesh, j);
      add_to(numbers,
             evaluate(*a.mesh, a.positions, contact.feature_a, *b.mesh, b.positions, contact.feature_b));
      const ContactGeometry moved = evaluate(*a.mesh, a.positions, *b.mesh, b.positions, contact);
      add_to(numbers, moved);
      const FollowedContact followed = follow(*a.mesh, a.positions, *b.mesh, b.positions, contact);
      add_to(numbers, followed.geometry);
      numbers.insert(numbers.end(), {double(followed.is_known), double(followed.steps)});
      const SurfaceWeights shares = weights(*a.mesh, a.positions, contact.feature_a, moved.point_b);
      numbers.insert(numbers.end(), shares.weight.begin(), shares.weight.end());
    }
  return numbers;
}

/// Whether numbers are the same, by their bits.
bool are_same_bits(const std::vector<double>& numbers, const std::vector<double>& others) {
  return numbers.size() == others.size() &&
         std::memcmp(numbers.data(), others.data(), numbers.size() * sizeof(double)) == 0;
}

template <typename Point>
void check_between_steps(double factor) {
  CAPTURE(factor, sizeof(Point));
  const auto a = scaled<Point>(models::torus(8, 6, 0.5, 0.2), factor, {0, 0, 0});
  const auto b = scaled<Point>(models::box({0.7, 0.5, 0.9}), factor, {0.4, 0.1, 0.2});
  const std::vector<double> expected = computed_between(a, b);
  for (const Mode& mode : modes()) {
    INFO("rounding " << mode.rounding << (mode.flush ? ", flushing" : ""));
    std::vector<double> numbers;
    Mode after;
    {
      const ModeScope scope(mode);
      numbers = computed_between(a, b);
      after = current_mode();
    }
    CHECK(are_same_bits(numbers, expected));
    CHECK(after == mode);
  }
}

/// The distance of a contact whose positions are of the size of the smallest denormals, or -1 for none.
double denormal_distance(const Positions& positions) {
  NeedleOverPlate pair(tests::settings_of(0x1p-1060, 1));
  pair.scene.set_positions(pair.needle, positions);
  const ReportHandle report = pair.scene.step();
  return report->contacts().empty() ? -1 : report->contacts()[0].distance;
}

}  // namespace

TEST_CASE("flush-to-zero, denormals-are-zero, each rounding mode: the same bits, and left as it was") {
  const Prepared prepared;
  for (const unsigned threads : {1U, 3U}) {
    const auto expected = play_in_mode(prepared, threads, Mode{}).reports;
    std::size_t contacts = 0;
    for (const ReportHandle& report : expected) contacts += report->contacts().size();
    CHECK(contacts > 100);
    for (const Mode& mode : modes()) {
      const Played played = play_in_mode(prepared, threads, mode);
      INFO(threads << " threads, rounding " << mode.rounding << (mode.flush ? ", flushing" : ""));
      CHECK(played.mode_was_kept);
      for (std::size_t frame = 0; frame < frame_count; ++frame)
        REQUIRE(difference_of(*played.reports[frame], *expected[frame]) == "");
    }
    std::cout << "compared " << modes().size() << " modes, " << contacts << " contacts each\n";
  }
}

TEST_CASE("flush-to-zero and each rounding mode at once in foreign threads") {
  const Prepared prepared;
  const auto expected = play_in_mode(prepared, 1, Mode{}).reports;
  const auto all = modes();
  for (const unsigned threads : {1U, 3U}) {
    std::vector<Played> played(all.size());
    std::vector<std::thread> foreign;
    for (std::size_t i = 0; i < all.size(); ++i)
      foreign.emplace_back([&, i] { played[i] = play_in_mode(prepared, threads, all[i]); });
    for (std::thread& thread : foreign) thread.join();
    for (std::size_t i = 0; i < all.size(); ++i) {
      INFO(threads << " threads, rounding " << all[i].rounding << (all[i].flush ? ", flushing" : ""));
      CHECK(played[i].mode_was_kept);
      for (std::size_t frame = 0; frame < frame_count; ++frame)
        REQUIRE(difference_of(*played[i].reports[frame], *expected[frame]) == "");
    }
    std::cout << "compared " << all.size() << " threads in modes of their own\n";
  }
}

TEST_CASE("flush-to-zero and each rounding mode: denormal distances are right") {
  const Positions positions = {{0.25, 0.5, 0x1p-1070}, {0.125, 0.5, 4}, {0.375, 0.5, 4}};
  for (const Mode& mode : modes()) {
    double distance = 0;
    Mode after;
    {
      const ModeScope scope(mode);
      distance = denormal_distance(positions);
      after = current_mode();
    }
    CHECK(distance == 0x1p-1070);
    CHECK(after == mode);
  }
}

TEST_CASE("flush-to-zero and each rounding mode: denormal settings are taken as they are") {
  for (const Mode& mode : modes()) {
    INFO("rounding " << mode.rounding << (mode.flush ? ", flushing" : ""));
    const auto in_mode = [&](const auto& call) {
      const ModeScope scope(mode);
      call();
      return current_mode();
    };
    std::unique_ptr<Scene> scene;
    std::shared_ptr<const Mesh> plate;
    std::shared_ptr<const Mesh> needle;
    ObjectSettings rigid = motion_of(Motion::rigid);
    rigid.margin = 0x1p-1062;
    CHECK(in_mode([&] { plate = plate_mesh(); }) == mode);
    CHECK(in_mode([&] { needle = needle_mesh(); }) == mode);
    CHECK(in_mode([&] { scene = std::make_unique<Scene>(settings_of(0x1p-1062, 0x1p-1061)); }) == mode);
    CHECK(in_mode([&] { scene->add(plate, rigid); }) == mode);
    ObjectId other;
    CHECK(in_mode([&] { other = scene->add(needle, rigid); }) == mode);
    CHECK(in_mode([&] { scene->set_pose(other, lift_pose(0x1p-1062)); }) == mode);
    const ReportHandle near = scene->step();
    REQUIRE(near->pairs().size() == 1);
    CHECK(near->pairs()[0].phase == PairPhase::began);
    // A rule in place of the settings: in range, and not in contact, since margins count.
    CHECK(in_mode([&] { scene->set_rule(0, 0, {0, 0x1p-1060, {}}); }) == mode);
    CHECK(in_mode([&] { scene->set_pose(other, lift_pose(0x1.8p-1061)); }) == mode);
    const ReportHandle apart = scene->step();
    REQUIRE(apart->pairs().size() == 1);
    CHECK(apart->pairs()[0].phase == PairPhase::ended);
    CHECK(scene->step()->pairs()[0].phase == PairPhase::near);
  }
}

TEST_CASE("flush-to-zero and each rounding mode: positions, evaluate and weights have the same bits") {
  check_between_steps<Eigen::Vector3d>(1);
  check_between_steps<Eigen::Vector3d>(0x1p-260);  // squares of areas are denormal
  check_between_steps<Eigen::Vector3f>(1);
  check_between_steps<Eigen::Vector3f>(0x1p-132);  // positions are denormal floats
}

TEST_CASE("flush-to-zero and each rounding mode: poses of denormal floats are taken as they are") {
  constexpr float height = 0x1p-140F;
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.translation().z() = height;
  for (const Mode& mode : modes())
    for (const bool as_matrix : {false, true}) {
      INFO("rounding " << mode.rounding << (mode.flush ? ", flushing" : "") << ", a matrix: " << as_matrix);
      Scene scene(settings_of(0x1p-138, 1));
      scene.add(plate_mesh(), motion_of(Motion::rigid));
      const ObjectId needle = scene.add(needle_mesh(), motion_of(Motion::rigid));
      {
        const ModeScope scope(mode);
        if (as_matrix)
          scene.set_pose(needle, pose.matrix());
        else
          scene.set_pose(needle, pose);
      }
      const ReportHandle report = scene.step();
      REQUIRE(report->pairs().size() == 1);
      CHECK(report->pairs()[0].distance.upper == 0x1p-140);
    }
}

TEST_CASE("flush-to-zero and each rounding mode: a contact at a denormal distance keeps its sign") {
  Contact contact;
  contact.kind = ContactKind::VF;
  contact.feature_b.kind = FeatureKind::face;
  contact.side_b = Side::back;
  contact.normal = {0, 0, 1};
  contact.distance = 0x1p-1070;
  for (const Mode& mode : modes()) {
    double separation = 0;
    Eigen::Vector3d push;
    {
      const ModeScope scope(mode);
      separation = contact.separation();
      push = contact.push();
    }
    CHECK(separation == -0x1p-1070);
    CHECK(push == Eigen::Vector3d(0, 0, -1));
  }
}

#if defined(__GLIBC__)
TEST_CASE("bad input does not trap where the caller traps invalid operations") {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  Positions positions(3, Eigen::Vector3d::Constant(nothing));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = nothing;
  SceneSettings bad_range = settings_of(0, nothing);
  ObjectSettings bad_margin;
  bad_margin.margin = nothing;
  NeedleOverPlate pair(settings_of(0.5, 1));
  const ObjectId rigid = pair.scene.add(needle_mesh(), motion_of(Motion::rigid));
  bool refused = false;
  std::fenv_t before{};
  std::fegetenv(&before);
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  pair.scene.set_positions(pair.plate, positions);
  pair.scene.set_positions(pair.needle, positions, nothing);
  pair.scene.bind_positions(pair.needle, positions);
  pair.scene.positions_changed(pair.needle, nothing);
  pair.scene.set_pose(rigid, pose);
  pair.scene.set_rule(0, 0, {0, nothing, {}});
  const ReportHandle report = pair.scene.step();
  try {
    const Scene scene(bad_range);
  } catch (const Error&) {
    refused = true;
  }
  CHECK_THROWS_AS(pair.scene.add(needle_mesh(), bad_margin), Error);
  std::fesetenv(&before);
  CHECK(refused);
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::wrong_count, DiagnosticKind::broken_promise,
                                         DiagnosticKind::not_finite, DiagnosticKind::broken_promise,
                                         DiagnosticKind::bad_pose, DiagnosticKind::bad_rule,
                                         DiagnosticKind::not_finite});
}
#endif

}  // namespace graze::tests
