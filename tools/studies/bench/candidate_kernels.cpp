#include "bench/candidate_kernels.hpp"

#include <deque>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "closest_features/key_order.hpp"
#include "core/surface/surface.hpp"
#include "leaves/feature_pairs.hpp"
#include "leaves/layout/listed_vertices.hpp"
#include "leaves/leaf_scratch.hpp"
#include "measure/measure_batch.hpp"

namespace graze::bench {
namespace {

/// The vertices and edges of a mesh of triangles, each with the first triangle that has it.
class Belongings {
 public:
  explicit Belongings(const Mesh& mesh) : vertices_(mesh.face_count()), edges_(mesh.face_count()) {
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex)
      if (mesh.is_used(vertex)) vertices_[mesh.vertex_faces(vertex).front()].push_back(vertex);
    for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge)
      edges_[mesh.edge_faces(edge).front()].push_back(edge);
  }
  [[nodiscard]] std::span<const std::uint32_t> vertices(std::uint32_t triangle) const {
    return vertices_[triangle];
  }
  [[nodiscard]] std::span<const std::uint32_t> edges(std::uint32_t triangle) const {
    return edges_[triangle];
  }

 private:
  std::vector<std::vector<std::uint32_t>> vertices_;
  std::vector<std::vector<std::uint32_t>> edges_;
};

/// An object, and its vertices in the frame of all.
struct LocalObject {
  LocalObject(std::shared_ptr<const Mesh> mesh, const Belongings& has) : surface(std::move(mesh)), of(has) {}

  Surface surface;
  const Belongings& of;
  std::vector<kernels::Point> vertices;
  std::size_t frame = 0;  ///< that it was brought up to last
};

/// The features that belong to some triangles of an object.
class Belonging {
 public:
  void take(const LocalObject& object, std::span<const std::uint32_t> triangles) {
    const IndexedMesh& mesh = object.surface.mesh();
    features.vertices.begin(3 * triangles.size());
    features.edges.begin(3 * triangles.size());
    features.triangles.begin(triangles.size());
    features.folds.begin(0);
    of_vertices_.begin(3 * triangles.size());
    of_edges_.begin(6 * triangles.size());
    of_triangles_.begin(3 * triangles.size());
    for (const std::uint32_t triangle : triangles) {
      features.vertices.add(object.of.vertices(triangle));
      features.edges.add(object.of.edges(triangle));
      features.triangles.add(triangle);
      for (const std::uint32_t vertex : object.of.vertices(triangle)) of_vertices_.add(vertex);
      for (const std::uint32_t edge : object.of.edges(triangle))
        for (const std::uint32_t end : mesh.edge(edge)) of_edges_.add(end);
      for (const std::uint32_t corner : mesh.face(triangle)) of_triangles_.add(corner);
    }
    features.vertices.lay_out(object.vertices.data(), of_vertices_.padded());
    features.edges.lay_out(object.vertices.data(), of_edges_.padded());
    features.triangles.lay_out(object.vertices.data(), of_triangles_.padded());
  }

  LeafFeatures features;

 private:
  CornerList of_vertices_;
  CornerList of_edges_;
  CornerList of_triangles_;
};

class CandidateKernels final : public Contender {
 public:
  CandidateKernels(const BenchScene& scene, const World& world, std::unique_ptr<Contender> candidates,
                   InstructionSet set)
      : world_(world), candidates_(std::move(candidates)), set_(set) {
    for (const Body& body : scene.bodies) {
      const auto known = belongings_.try_emplace(body.mesh.get(), *body.mesh).first;
      objects_.emplace_back(body.mesh, known->second);
    }
    const Box& box = objects_.front().surface.box();
    scratch_.frame = FilterFrame(box, box);
  }

  void frame() override {
    use_instruction_set(set_);
    ++frame_;
    answers_.clear();
    contacts_.clear();
    near_.clear();
    candidates_->frame();
    candidates_->collect(near_);
    const std::span<const TrianglePair> all = near_.triangle_pairs;
    for (std::size_t begin = 0; begin < all.size();) {
      std::size_t end = begin;
      while (end < all.size() && all[end].object_a == all[begin].object_a &&
             all[end].object_b == all[begin].object_b)
        ++end;
      answer(all.subspan(begin, end - begin));
      begin = end;
    }
  }

  void collect(Found& found) const override {
    const auto feature = [](const Feature& named) {
      return FeaturePair::Feature{static_cast<std::uint32_t>(named.kind), named.index};
    };
    for (const Answer& answer : answers_)
      for (const Contact& contact : std::span(contacts_).subspan(answer.first_contact, answer.contact_count))
        found.feature_pairs.push_back(
            {answer.a, answer.b, feature(contact.feature_a), feature(contact.feature_b), contact.distance});
  }

 private:
  struct Answer {
    std::uint32_t a, b;
    std::size_t first_contact, contact_count;
  };

  const LocalObject& brought_up(std::uint32_t index) {
    LocalObject& object = objects_[index];
    if (std::exchange(object.frame, frame_) == frame_) return object;
    const std::uint32_t count = object.surface.mesh().vertex_count();
    object.surface.set_positions(PositionView(world_.positions_of(index), count));
    object.vertices.resize(count);
    for (std::size_t vertex = all_.size(); vertex < count; ++vertex)
      all_.push_back(static_cast<std::uint32_t>(vertex));
    to_frame(object.surface, std::span(all_).first(count), scratch_.frame, object.vertices.data());
    return object;
  }

  /// The contacts of a pair of objects.
  void answer(std::span<const TrianglePair> candidates) {
    const std::uint32_t a = candidates.front().object_a;
    const std::uint32_t b = candidates.front().object_b;
    const LocalObject& of_a = brought_up(a);
    const LocalObject& of_b = brought_up(b);
    const SurfacePair pair{of_a.surface, of_b.surface, count_};
    names_.clear();
    piercing_.clear();
    CloseFeatures features(pair, world_.distance, scratch_, names_, piercing_);
    for (std::size_t begin = 0; begin < candidates.size();) {
      const std::uint32_t triangle = candidates[begin].triangle_a;
      beside_.clear();
      for (; begin < candidates.size() && candidates[begin].triangle_a == triangle; ++begin)
        beside_.push_back(candidates[begin].triangle_b);
      add_names(pair, of_a, triangle, of_b, features);
    }
    features.finish();
    order_.sort(names_);
    names_.resize(keep_nearest_of_each(pair, names_));
    const std::size_t first = contacts_.size();
    contacts_.resize(first + names_.size());
    measure(pair, names_, std::span(contacts_).subspan(first), measuring_);
    answers_.push_back({a, b, first, names_.size()});
  }

  /// Adds the close features of one triangle of a and of the triangles of b beside it.
  void add_names(const SurfacePair& pair, const LocalObject& a, std::uint32_t triangle, const LocalObject& b,
                 CloseFeatures& features) {
    one_.take(a, std::span(&triangle, 1));
    others_.take(b, beside_);
    constexpr kernels::SlabInFrame no_slab{{0, 0, 0}, 0, 0};
    const float limit = scratch_.frame.to_local_limit(world_.distance);
    const kernels::BoxInFrame box_b = scratch_.frame.to_local(pair.b.box());
    kernels::BoxInFrame near_a = empty_box();
    scratch_.a.select_near(one_.features, {box_b, box_b, no_slab, limit}, &near_a);
    if (is_empty(near_a)) return;
    kernels::BoxInFrame near_b = empty_box();
    scratch_.b.select_near(others_.features, {near_a, near_a, no_slab, limit}, &near_b);
    if (is_empty(near_b)) return;
    scratch_.a.select_near(one_.features, {near_b, near_b, no_slab, limit}, nullptr);
    features.add_selected();
  }

  const World& world_;
  std::unique_ptr<Contender> candidates_;
  InstructionSet set_;
  std::map<const Mesh*, Belongings> belongings_;
  std::deque<LocalObject> objects_;  ///< a surface stays where it is
  std::size_t frame_ = 0;
  Found near_;
  std::vector<std::uint32_t> all_;     ///< 0, 1, 2, …
  std::vector<std::uint32_t> beside_;  ///< triangles of b near one of a
  Belonging one_;
  Belonging others_;
  LeafScratch scratch_;
  DecisionCount count_;
  std::vector<FeaturePairKey> names_;
  PiercingEdges piercing_;
  KeyOrder order_;
  MeasureScratch measuring_;
  std::vector<Contact> contacts_;
  std::vector<Answer> answers_;
};

}  // namespace

std::unique_ptr<Contender> make_candidate_kernels(const BenchScene& scene, const World& world,
                                                  std::unique_ptr<Contender> candidates, InstructionSet set) {
  return std::make_unique<CandidateKernels>(scene, world, std::move(candidates), set);
}

}  // namespace graze::bench
