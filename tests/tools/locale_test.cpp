// A locale with a decimal comma does not change what is read.

#include <clocale>
#include <functional>
#include <graze/io/mesh_file.hpp>
#include <graze/io/player.hpp>
#include <iostream>
#include <locale>

#include "support/catch.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using graze::io::MeshFile;
using graze::tests::TemporaryFolder;

/// Decimal commas and grouped digits for C++ streams, and for C where such a locale is installed.
class CommaScope {
 public:
  CommaScope()
      : c_before_(std::setlocale(LC_ALL, nullptr)),
        before_(std::locale::global(std::locale(std::locale(), new Commas))) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"})
      if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  ~CommaScope() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, c_before_.c_str());
  }
  CommaScope(const CommaScope&) = delete;
  CommaScope& operator=(const CommaScope&) = delete;

 private:
  struct Commas : std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\1"; }
  };

  std::string c_before_;
  std::locale before_;
};

/// One triangle of awkward numbers, in every format of text.
const std::vector<std::pair<const char*, const char*>> mesh_texts{
    {"a.obj", "v 0.125 -1234.5678 1e-3\nv 1.5 0.1 2e2\nv 0.3 12345.25 -0.7\nf 1 2 3\n"},
    {"a.off", "OFF\n3 1 0\n0.125 -1234.5678 1e-3\n1.5 0.1 2e2\n0.3 12345.25 -0.7\n3 0 1 2\n"},
    {"a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
     "0.125 -1234.5678 1e-3\n1.5 0.1 2e2\n0.3 12345.25 -0.7\n3 0 1 2\n"},
    {"a.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0.125 -1234.5678 1e-3\nvertex 1.5 0.1 2e2\n"
     "vertex 0.3 12345.25 -0.7\nendloop\nendfacet\nendsolid a\n"},
};

const char* const scene_text =
    R"({"graze": 1, "contact_distance": 0.0625, "range": 1234.5, "accuracy": {"within": 0.001},
       "objects": [{"mesh": "a.obj", "name": "a", "motion": "rigid", "margin": 0.03,
                    "transform": {"translate": [0.1, 2.5, -1e-3], "scale": 0.5}},
                   {"mesh": "a.ply", "name": "b"}]})";

std::vector<Eigen::Vector3d> positions_of(const std::filesystem::path& path) {
  const MeshFile file = MeshFile::read(path);
  const auto rest = file.objects()[0].mesh->rest();
  return {rest.begin(), rest.end()};
}

/// Returns the witness in the report of a scene file's first step.
std::vector<Eigen::Vector3d> witness_of(const std::filesystem::path& path) {
  graze::io::Player player(graze::io::read_scene_file(path));
  player.advance(0);
  const graze::ReportHandle report = player.scene().step();
  REQUIRE(report->pairs().size() == 1);
  const graze::SceneSettings& settings = player.scene().settings();
  const graze::PairReport& row = report->pairs()[0];
  return {row.witness.point_a, row.witness.point_b,
          Eigen::Vector3d(settings.contact_distance, settings.range, settings.accuracy.tolerance())};
}

}  // namespace

TEST_CASE("a locale with a decimal comma: mesh and scene files are read alike") {
  const TemporaryFolder folder;
  for (const auto& [name, text] : mesh_texts) folder.write(name, text);
  folder.write("scene.json", scene_text);
  const auto check = [](const std::function<std::vector<Eigen::Vector3d>()>& read) {
    const auto expected = read();
    const CommaScope scope;
    CHECK(read() == expected);
  };
  CHECK(positions_of(folder / "a.obj")[0] == Eigen::Vector3d(0.125, -1234.5678, 1e-3));
  for (const auto& mesh : mesh_texts) {
    INFO(mesh.first);
    check([&] { return positions_of(folder / mesh.first); });
  }
  check([&] { return witness_of(folder / "scene.json"); });
  std::cout << "compared " << mesh_texts.size() + 1 << " files\n";
}
