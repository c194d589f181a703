// Bad input to one object: the diagnostic that names it, and everything else as if nothing had happened.

#include <iostream>
#include <set>

#include "hard_cases/scene_comparison.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t object_count = 6;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Six small shapes in one place, the last of them rigid.
struct Stage {
  explicit Stage(ContactDetail detail) : scene(settings_of(0.3, 1, detail)) {
    for (std::uint64_t i = 0; i < object_count; ++i) {
      const auto mesh = mesh_of(oracle::random_scene(10 + 2 * i).a);
      positions.emplace_back(mesh->rest().begin(), mesh->rest().end());
      ids.push_back(scene.add(mesh, motion_of(i + 1 == object_count ? Motion::rigid : Motion::deformable)));
    }
  }
  /// A vertex that a face uses.
  [[nodiscard]] std::uint32_t used_vertex(std::size_t object) const {
    return scene.mesh(ids[object])->face(0)[1];
  }
  /// Object `object` as it is but for one coordinate.
  [[nodiscard]] Positions spoiled(std::size_t object, double coordinate) const {
    Positions result = positions[object];
    result[used_vertex(object)].y() = coordinate;
    return result;
  }

  Scene scene;
  std::vector<ObjectId> ids;
  std::vector<Positions> positions;
};

/// Something wrong to say to object `object`, and the diagnostic it leaves.
struct Wrong {
  const char* what;
  DiagnosticKind kind;
  bool names_vertex;
  void (*say)(Stage& stage, std::size_t object);
};

const std::vector<Wrong>& wrongs() {
  using enum DiagnosticKind;
  static const std::vector<Wrong> all{
      {"NaN", not_finite, true,
       [](Stage& s, std::size_t i) { s.scene.set_positions(s.ids[i], s.spoiled(i, nothing)); }},
      {"infinity", not_finite, true,
       [](Stage& s, std::size_t i) { s.scene.set_positions(s.ids[i], s.spoiled(i, infinity)); }},
      {"minus infinity", not_finite, true,
       [](Stage& s, std::size_t i) { s.scene.set_positions(s.ids[i], s.spoiled(i, -infinity)); }},
      {"one position too few", wrong_count, false,
       [](Stage& s, std::size_t i) {
         s.scene.set_positions(s.ids[i], PositionView(s.positions[i][0].data(), s.positions[i].size() - 1));
       }},
      {"a stale id", stale_id, false,
       [](Stage& s, std::size_t i) {
         const ObjectId stale{s.ids[i].index, s.ids[i].generation + 7};
         s.scene.set_positions(stale, s.spoiled(i, 5));
       }},
      {"a foreign id", stale_id, false,
       [](Stage& s, std::size_t i) {
         Scene other;
         ObjectId foreign;
         for (std::size_t k = 0; k < 20 + i; ++k) foreign = other.add(plate_mesh());
         s.scene.remove(foreign);
       }},
      {"null memory", null_memory, false,
       [](Stage& s, std::size_t i) {
         s.scene.bind_positions(s.ids[i],
                                PositionView(static_cast<const double*>(nullptr), s.positions[i].size()));
       }},
      {"misaligned memory", misaligned_memory, false,
       [](Stage& s, std::size_t i) {
         s.scene.bind_positions(s.ids[i], PositionView(s.positions[i][0].data(), s.positions[i].size(), 25));
       }},
      {"a pose", wrong_motion, false,
       [](Stage& s, std::size_t i) { s.scene.set_pose(s.ids[i], lift_pose(3)); }},
  };
  return all;
}

}  // namespace

TEST_CASE(
    "NaN, infinity, wrong count, stale or foreign id, null or misaligned memory: the others as before") {
  std::size_t compared = 0;
  for (const ContactDetail detail : all_details) {
    Stage undisturbed(detail);
    const ReportHandle expected = undisturbed.scene.step();
    REQUIRE(expected->pairs().size() > 10);
    for (const Wrong& wrong : wrongs())
      for (std::size_t object = 0; object + 1 < object_count; ++object) {
        INFO(wrong.what << " for object " << object);
        Stage stage(detail);
        wrong.say(stage, object);
        const ReportHandle report = stage.scene.step();
        REQUIRE(kinds_of(*report) == std::vector{wrong.kind});
        const Diagnostic& diagnostic = report->diagnostics()[0];
        if (wrong.kind != DiagnosticKind::stale_id) CHECK(diagnostic.object == stage.ids[object]);
        if (wrong.names_vertex) {
          const std::string vertex = "vertex " + std::to_string(stage.used_vertex(object)) + " ";
          CHECK(diagnostic.message.find(vertex) != std::string::npos);
        }
        CHECK(rows_of(*report) == rows_of(*expected));
        ++compared;
      }
  }
  std::cout << "compared " << compared << " scenes with bad input\n";
}

TEST_CASE("NaN and infinity in bound memory: that object's pairs are stale, the others as before") {
  std::size_t compared = 0;
  for (const ContactDetail detail : all_details) {
    Stage undisturbed(detail);
    undisturbed.scene.step();
    const ReportHandle expected = undisturbed.scene.step();
    for (const double bad : {nothing, infinity, -infinity})
      for (std::size_t object = 0; object + 1 < object_count; ++object) {
        INFO(bad << " in object " << object);
        Stage stage(detail);
        Positions memory = stage.positions[object];
        stage.scene.bind_positions(stage.ids[object], memory);
        const ReportHandle good = stage.scene.step();
        memory[stage.used_vertex(object)].z() = bad;
        const ReportHandle report = stage.scene.step();
        REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::not_finite});
        CHECK(report->diagnostics()[0].object == stage.ids[object]);
        REQUIRE(report->pairs().size() == expected->pairs().size());
        for (std::size_t i = 0; i < report->pairs().size(); ++i) {
          const PairReport& row = report->pairs()[i];
          const bool own = row.a == stage.ids[object] || row.b == stage.ids[object];
          CHECK(row.stale == own);
          PairReport same = row;
          same.stale = false;
          if (row.phase == PairPhase::touching || row.phase == PairPhase::near)
            CHECK(text_of(*report, same) == text_of(*expected, expected->pairs()[i]));
          ++compared;
        }
      }
  }
  std::cout << "compared " << compared << " pairs beside and of a frozen object\n";
}

}  // namespace graze::tests
