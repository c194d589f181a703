#include <cstring>
#include <limits>
#include <thread>

#include "c_interface/c_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {

TEST_CASE("c: null is refused by every function, and says which parameter") {
  graze_mesh* mesh = nullptr;
  graze_scene* scene = nullptr;
  const auto triangle = c_mesh(models::box({1, 1, 1}));
  const auto real = c_scene({});
  const graze_id none{};
  double point[3] = {0, 0, 0};
  expect_fails(graze_mesh_from_triangles(nullptr, nullptr, 0, &mesh), GRAZE_BAD_ARGUMENT, "rest");
  expect_fails(graze_mesh_from_triangles(nullptr, nullptr, 0, nullptr), GRAZE_BAD_ARGUMENT, "mesh");
  expect_fails(graze_mesh_share(nullptr, &mesh), GRAZE_BAD_ARGUMENT, "mesh");
  expect_fails(graze_scene_new(nullptr, nullptr, nullptr), GRAZE_BAD_ARGUMENT, "scene");
  expect_fails(graze_scene_add(nullptr, triangle.get(), nullptr, nullptr), GRAZE_BAD_ARGUMENT, "object");
  graze_id id{};
  expect_fails(graze_scene_add(nullptr, triangle.get(), nullptr, &id), GRAZE_BAD_ARGUMENT, "scene");
  expect_fails(graze_scene_add(real.get(), nullptr, nullptr, &id), GRAZE_BAD_ARGUMENT, "mesh");
  expect_fails(graze_scene_step(nullptr, 0, nullptr), GRAZE_BAD_ARGUMENT, "scene");
  expect_fails(graze_scene_set_poses(real.get(), &none, 1, nullptr, false), GRAZE_BAD_ARGUMENT, "rows");
  expect_fails(graze_scene_set_poses(real.get(), nullptr, 1, point, false), GRAZE_BAD_ARGUMENT, "objects");
  expect_fails(graze_scene_set_positions(real.get(), &none, 1, nullptr, 0), GRAZE_BAD_ARGUMENT, "positions");
  expect_fails(graze_scene_reserve(real.get(), nullptr), GRAZE_BAD_ARGUMENT, "capacity");
  expect_fails(graze_scene_latest_report(real.get(), nullptr), GRAZE_BAD_ARGUMENT, "report");
  expect_fails(graze_scene_get_settings(real.get(), nullptr), GRAZE_BAD_ARGUMENT, "settings");
  expect_fails(graze_recorder_new(real.get(), nullptr, nullptr, nullptr), GRAZE_BAD_ARGUMENT, "recorder");
  graze_recorder* recorder = nullptr;
  expect_fails(graze_recorder_new(real.get(), nullptr, nullptr, &recorder), GRAZE_BAD_ARGUMENT, "file");
  graze_recording* recording = nullptr;
  expect_fails(graze_recording_open(nullptr, &recording), GRAZE_BAD_ARGUMENT, "file");
  expect_fails(graze_scene_query_new(nullptr, nullptr), GRAZE_BAD_ARGUMENT, "query");
  std::size_t count = 0;
  expect_fails(graze_scene_query_cast_ray(nullptr, point, point, 1, nullptr, nullptr, 0, &count),
               GRAZE_BAD_ARGUMENT, "query");
  expect_fails(graze_use_instruction_set(nullptr), GRAZE_BAD_ARGUMENT, "name");
  CHECK(mesh == nullptr);
  CHECK(scene == nullptr);
  CHECK(recorder == nullptr);
}

TEST_CASE("c: getters of null give nothing, and null is released") {
  CHECK(graze_mesh_vertex_count(nullptr) == 0);
  CHECK(graze_mesh_rest(nullptr) == nullptr);
  CHECK(graze_scene_object_count(nullptr) == 0);
  CHECK_FALSE(graze_scene_contains(nullptr, graze_id{}));
  CHECK(graze_report_frame(nullptr) == 0);
  std::size_t count = 5;
  CHECK(graze_report_pairs(nullptr, &count) == nullptr);
  CHECK(count == 0);
  CHECK(graze_recording_frame_count(nullptr) == 0);
  CHECK(graze_recording_made_by(nullptr) == nullptr);
  CHECK_FALSE(graze_replay_get_difference(nullptr, nullptr));
  graze_mesh_release(nullptr);
  graze_scene_release(nullptr);
  graze_report_release(nullptr);
  graze_query_release(nullptr);
  graze_scene_query_release(nullptr);
  graze_probe_release(nullptr);
  graze_recorder_release(nullptr);
  graze_recording_release(nullptr);
  graze_replay_release(nullptr);
}

TEST_CASE("c: what the C++ interface throws is refused, with its sentence") {
  graze_scene_settings settings;
  expect_ok(graze_scene_settings_init(&settings, sizeof settings));
  settings.contact_distance = -1;
  graze_scene* scene = nullptr;
  expect_fails(graze_scene_new(&settings, nullptr, &scene), GRAZE_REFUSED, "contact_distance");
  settings.contact_distance = 0;
  settings.detail = 77;
  expect_fails(graze_scene_new(&settings, nullptr, &scene), GRAZE_REFUSED, "detail");
  settings.detail = GRAZE_DETAIL_FEATURES;
  settings.accuracy = 9;
  expect_fails(graze_scene_new(&settings, nullptr, &scene), GRAZE_BAD_ARGUMENT, "accuracy");
  settings.accuracy = GRAZE_EXACT;
  settings.tolerance = 1;
  expect_fails(graze_scene_new(&settings, nullptr, &scene), GRAZE_BAD_ARGUMENT, "tolerance");
  CHECK(scene == nullptr);

  const models::MeshData box = models::box({1, 1, 1});
  const graze_positions rest = doubles(box.positions);
  const std::uint32_t corners[3] = {0, 1, 99};
  graze_mesh* mesh = nullptr;
  expect_fails(graze_mesh_from_triangles(&rest, corners, 1, &mesh), GRAZE_REFUSED, "99");
  expect_fails(graze_mesh_from_triangles(&rest, corners, 0, &mesh), GRAZE_REFUSED, "face");
  expect_fails(graze_mesh_from_triangles(&rest, corners, SIZE_MAX, &mesh), GRAZE_BAD_ARGUMENT, "memory");
  CHECK(mesh == nullptr);
  const auto sheet = c_mesh(models::sheet(3, 3, 1, 1));
  graze_probe* probe = nullptr;
  expect_fails(graze_probe_new(sheet.get(), true, &probe), GRAZE_REFUSED, "closed");
  graze_recording* recording = nullptr;
  expect_fails(graze_recording_open("/does/not/exist", &recording), GRAZE_REFUSED, "/does/not/exist");
  expect_fails(graze_use_instruction_set("abacus"), GRAZE_BAD_ARGUMENT, "abacus");
}

TEST_CASE("c: settings of another size") {
  graze_scene_settings settings;
  expect_fails(graze_scene_settings_init(&settings, 0), GRAZE_BAD_ARGUMENT, "bytes");
  expect_fails(graze_scene_settings_init(&settings, std::size_t{1} << 40U), GRAZE_BAD_ARGUMENT, "bytes");
  // One that was never initialised.
  std::memset(&settings, 0, sizeof settings);
  graze_scene* scene = nullptr;
  expect_fails(graze_scene_new(&settings, nullptr, &scene), GRAZE_BAD_ARGUMENT, "init");

  // A program of an older version has the first members alone. The others keep their defaults.
  struct Older {
    std::size_t struct_size;
    double contact_distance;
  } older{sizeof(Older), 0.5};
  expect_ok(graze_scene_new(reinterpret_cast<const graze_scene_settings*>(&older), nullptr, &scene));
  expect_ok(graze_scene_settings_init(&settings, sizeof settings));
  expect_ok(graze_scene_get_settings(scene, &settings));
  CHECK(settings.contact_distance == 0.5);
  CHECK(settings.detail == GRAZE_DETAIL_FEATURES);
  CHECK(settings.sweep_tolerance == 1e-6);
  CHECK(settings.max_contacts == GRAZE_NO_LIMIT);
  // Reading settings fills no more than the program has.
  struct Guarded {
    Older older;
    std::uint64_t guard = 42;
  } guarded{{sizeof(Older), 0}};
  expect_ok(graze_scene_get_settings(scene, reinterpret_cast<graze_scene_settings*>(&guarded)));
  CHECK(guarded.older.contact_distance == 0.5);
  CHECK(guarded.older.struct_size == sizeof(Older));
  CHECK(guarded.guard == 42);
  graze_scene_release(scene);
  scene = nullptr;

  // A program of a newer version may ask for nothing that is not here.
  struct Newer {
    graze_scene_settings known;
    std::uint64_t unknown;
  } newer{};
  expect_ok(graze_scene_settings_init(&newer.known, sizeof newer));
  CHECK(newer.known.struct_size == sizeof newer);
  expect_ok(graze_scene_new(&newer.known, nullptr, &scene));
  graze_scene_release(scene);
  newer.unknown = 1;
  expect_fails(graze_scene_new(&newer.known, nullptr, &scene), GRAZE_BAD_ARGUMENT, "later version");
}

TEST_CASE("c: a message belongs to its thread") {
  static_cast<void>(graze_scene_step(nullptr, 0, nullptr));
  const std::string mine = graze_last_error();
  CHECK_FALSE(mine.empty());
  std::string others = "not asked";
  std::thread([&] { others = graze_last_error(); }).join();
  CHECK(others.empty());
  CHECK(graze_last_error() == mine);
}

TEST_CASE("c: a long message is cut between two characters") {
  std::string path = "/";
  for (int i = 0; i < 1000; ++i) path += "\u00e9";
  graze_recording* recording = nullptr;
  CHECK(graze_recording_open(path.c_str(), &recording) == GRAZE_REFUSED);
  const std::string said = graze_last_error();
  CHECK(said.size() > 500);
  CHECK(said.size() < 1024);
  CHECK((static_cast<unsigned char>(said.back()) & 0xC0U) != 0xC0U);  // no first byte without its second
}

}  // namespace graze::tests
