#include "c_interface/c_support.hpp"

#include "handles.hpp"
#include "scenes/report_hash.hpp"
#include "settings.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

std::uint64_t hash_of(const FrameReport& report) {
  scenes::ReportHash hash;
  hash.add(report);
  return hash.value();
}

/// Whether a function of C shows rows where they lie, and all of them.
template <typename Row, typename Same>
bool are_shown(const Row* (*rows)(const graze_report*, std::size_t*), const graze_report* report,
               std::span<const Same> held, std::span<const Same> expected) {
  std::size_t count = 0;
  const void* const first = rows(report, &count);
  return first == held.data() && count == held.size() && count == expected.size();
}

}  // namespace

void expect_ok(graze_status status) {
  INFO(graze_last_error());
  REQUIRE(status == GRAZE_OK);
}

void expect_fails(graze_status ended, graze_status status, const std::string& words) {
  CHECK(ended == status);
  INFO(graze_last_error());
  CHECK(std::string(graze_last_error()).find(words) != std::string::npos);
}

graze_positions doubles(std::span<const Eigen::Vector3d> points) {
  return {points.data(), points.size(), 0, 0, true};
}

Owned<graze_mesh> c_mesh(const models::MeshData& data) {
  graze_mesh* mesh = nullptr;
  const graze_positions rest = doubles(data.positions);
  expect_ok(graze_mesh_from_polygons(&rest, data.corners.data(), data.corners.size(),
                                     data.corner_counts.data(), data.corner_counts.size(), &mesh));
  return Owned<graze_mesh>(mesh);
}

graze_scene_settings c_settings(const SceneSettings& settings) {
  return c::to_c(settings);
}
graze_object_settings c_settings(const ObjectSettings& settings) {
  return c::to_c(settings);
}

Owned<graze_scene> c_scene(const SceneSettings& settings) {
  const graze_scene_settings given = c_settings(settings);
  graze_scene* scene = nullptr;
  expect_ok(graze_scene_new(&given, nullptr, &scene));
  return Owned<graze_scene>(scene);
}

std::array<double, 12> rows_of(const Eigen::Isometry3d& pose) {
  std::array<double, 12> rows;
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(rows.data()) = pose.matrix().topRows<3>();
  return rows;
}

bool is_same(const graze_report* report, const FrameReport& expected) {
  const FrameReport& held = report->report();
  return hash_of(held) == hash_of(expected) && graze_report_frame(report) == expected.frame() &&
         graze_report_tag(report) == expected.tag() && graze_report_complete(report) == expected.complete() &&
         are_shown(graze_report_pairs, report, held.pairs(), expected.pairs()) &&
         are_shown(graze_report_contacts, report, held.contacts(), expected.contacts()) &&
         are_shown(graze_report_region_distances, report, held.region_distances(),
                   expected.region_distances()) &&
         are_shown(graze_report_impacts, report, held.impacts(), expected.impacts()) &&
         graze_report_diagnostic_count(report) == expected.diagnostics().size();
}

}  // namespace graze::tests
