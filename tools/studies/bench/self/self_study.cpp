#include "bench/self/self_study.hpp"

#include <algorithm>
#include <graze/graze.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/run.hpp"
#include "bench/self/self_contacts.hpp"
#include "bench/stopwatch.hpp"
#include "distribution.hpp"
#include "examples/support/shapes.hpp"
#include "examples/support/world.hpp"
#include "progress.hpp"

namespace graze::bench {
namespace {

constexpr int side = 40;           // vertices along a side of the cloth
constexpr double width = 1.2;      // m
constexpr double gap = 0.01;       // m, the thickness of the cloth
constexpr double distance = 0.02;  // m, of contacts. It is less than 0.7 of an edge
constexpr double pace = 0.4;       // m/s, how fast the cloth is let down

/// A cloth that is let down onto a floor, edge first, as in tools/examples/self_cloth.cpp.
class FoldingCloth {
 public:
  FoldingCloth() : world_(settings()) {
    world_.add(examples::fixed_body(examples::floor_box(4, 0.5)));
    examples::Body cloth = examples::cloth(examples::hanging_sheet(width, side, 0.01, 12), 0.3);
    cloth.meets_itself = true;
    cloth_ = &world_.add(std::move(cloth));
    inverse_mass_ = cloth_->inverse_masses.front();
  }

  void frame() {
    constexpr int looks = 2;
    const bool is_held = cloth_->positions.back().z() > 0.1;
    for (std::size_t i = cloth_->positions.size() - side; i < cloth_->positions.size(); ++i) {
      cloth_->inverse_masses[i] = is_held ? 0 : inverse_mass_;
      if (is_held) cloth_->velocities[i] = {0, 0, -pace};
    }
    for (int look = 0; look < looks; ++look) world_.step(1.0 / 60 / looks);
  }
  [[nodiscard]] const examples::Body& cloth() const { return *cloth_; }

 private:
  static examples::WorldSettings settings() {
    examples::WorldSettings made;
    made.contact_distance = distance;
    made.contacts.gap = gap;
    made.contacts.friction = 0.3;
    made.damping = 2;
    made.substeps = 5;
    made.iterations = 2;
    return made;
  }

  examples::World world_;
  examples::Body* cloth_ = nullptr;
  double inverse_mass_ = 0;
};

class GrazeSelfContacts final : public SelfContactFinder {
 public:
  GrazeSelfContacts(const examples::Body& cloth, ContactDetail detail)
      : scene_({.contact_distance = distance, .range = distance, .detail = detail, .threads = 1}) {
    const ObjectId id = scene_.add(cloth.mesh, {.self = true, .self_rings = 0});
    scene_.bind_positions(id, cloth.positions);
  }

  void find() override { report_ = scene_.step(); }
  [[nodiscard]] std::size_t count() const override { return report_->contacts().size(); }
  void list_vertices(std::vector<std::uint32_t>& vertices) const override {
    vertices.clear();
    for (const Contact& contact : report_->contacts())
      for (const Feature& feature : {contact.feature_a, contact.feature_b})
        if (feature.kind == FeatureKind::vertex) vertices.push_back(feature.index);
  }

 private:
  Scene scene_;
  ReportHandle report_;
};

struct SelfContestant {
  std::string name;
  std::unique_ptr<SelfContactFinder> finder;
  std::vector<double> ms;
  std::vector<double> contacts;
  std::vector<double> vertices;  ///< that have one
};

std::vector<SelfContestant> self_contestants(const PeerModule& module, const examples::Body& cloth,
                                             std::span<const Triangle> triangles) {
  std::vector<SelfContestant> made;
  const auto add = [&](std::string name, std::unique_ptr<SelfContactFinder> finder) {
    made.push_back({std::move(name), std::move(finder), {}, {}, {}});
  };
  for (const auto& [name, detail] : {std::pair("graze nearest", ContactDetail::nearest),
                                     std::pair("graze features", ContactDetail::features)})
    add(name, std::make_unique<GrazeSelfContacts>(cloth, detail));
  auto bullet = module.self_contact_finder(
      {{cloth.positions.front().data(), 3 * cloth.positions.size()}, triangles}, distance);
  if (bullet != nullptr) add("Bullet", std::move(bullet));
  return made;
}

void measure(SelfContestant& contestant, std::vector<std::uint32_t>& vertices) {
  const Stopwatch watch(1);
  contestant.finder->find();
  contestant.ms.push_back(watch.ms());
  contestant.contacts.push_back(static_cast<double>(contestant.finder->count()));
  contestant.finder->list_vertices(vertices);
  std::sort(vertices.begin(), vertices.end());
  const auto end = std::unique(vertices.begin(), vertices.end());
  contestant.vertices.push_back(static_cast<double>(end - vertices.begin()));
}

}  // namespace

tools::ResultTable compare_self_contacts(const PeerModule& module, std::size_t frames) {
  FoldingCloth folding;
  const Mesh& mesh = *folding.cloth().mesh;
  std::vector<Triangle> triangles;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    triangles.push_back({{mesh.face(face)[0], mesh.face(face)[1], mesh.face(face)[2]}});
  std::vector<SelfContestant> contestants = self_contestants(module, folding.cloth(), triangles);
  std::vector<std::uint32_t> vertices;
  tools::Progress progress("folding cloth: frame", frames);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    progress.at(frame);
    folding.frame();
    for (SelfContestant& contestant : contestants) measure(contestant, vertices);
  }
  tools::ResultTable table{
      "self", "A cloth of 1,600 vertices that folds into a heap, near itself, on one thread",
      tools::columns_of({"contacts_from", "find_ms: ms a frame", "slowest_ms: ms the slowest",
                         "contacts: contacts a frame", "vertices: vertices that have one",
                         "most_contacts: contacts at most"})};
  table.timed = true;
  for (const SelfContestant& contestant : contestants) {
    const tools::Distribution times(contestant.ms);
    table.rows.push_back({contestant.name, times.median(), *std::ranges::max_element(contestant.ms),
                          tools::Distribution(contestant.contacts).median(),
                          tools::Distribution(contestant.vertices).median(),
                          *std::ranges::max_element(contestant.contacts)});
  }
  return table;
}

}  // namespace graze::bench
