#include "measure/measure_batch.hpp"

#include <algorithm>
#include <array>

#include "measure/measure.hpp"
#include "measure/normals.hpp"
#include "surface/corner_lane.hpp"
#include "surface/passes_for.hpp"

namespace graze {

namespace {

/// How many corners the simplices of a contact have, the lower number first.
struct Shape {
  std::uint32_t low = 0;
  std::uint32_t high = 0;

  friend bool operator==(const Shape&, const Shape&) = default;
};

Shape shape_of(const FeaturePairKey& key) {
  const auto [low, high] = std::minmax({corner_count(key.a()), corner_count(key.b())});
  return {low, high};
}

/// A piercing fold is left out since its normal is not the triangle's.
bool is_for_kernels(const FeaturePairKey& key, const Shape& shape) {
  if (key.meeting() == Meeting::pierced) return key.kind() == ContactKind::EF;
  return key.meeting() == Meeting::closest && shape.low + shape.high <= 4;
}

Eigen::Vector3d at(const kernels::Points& points, std::size_t lane) {
  return {points[0][lane], points[1][lane], points[2][lane]};
}

void measure_alone(const SurfacePair& pair, const FeaturePairKey& key, Contact& contact, Sides& sides) {
  contact = measure_without_sides(pair, key);
  sides.add(pair, key, contact);
}

void put_points(const Surface& surface, std::span<const std::uint32_t> vertices, double (*points)[4]) {
  with_points(surface, [&]<typename Number>(const kernels::PointArray<Number>& all) {
    for (const std::uint32_t vertex : vertices) {
      const Number* const point = all.numbers + std::size_t{3} * vertex;
      for (std::size_t axis = 0; axis < 3; ++axis) (*points)[axis] = point[axis];
      ++points;
    }
  });
}

/// Measures contacts of vertices, as many at once as the kernel takes.
class VertexContacts {
 public:
  VertexContacts(const SurfacePair& pair, MeasureScratch& scratch)
      : pair_(pair), sides_(scratch.sides), batch_(scratch.vertices) {}

  void measure(std::span<const FeaturePairKey> keys, Contact* contacts) {
    lay_out(keys);
    kernels::measure().vertices(batch_);
    for (std::size_t i = 0; i < keys.size(); ++i) take(i, keys[i], contacts[i]);
  }

 private:
  void lay_out(std::span<const FeaturePairKey> keys) {
    std::array<std::uint32_t, kernels::vertices_at_once> a, b;
    const std::size_t rows = (keys.size() + 3) / 4 * 4;
    batch_.count = keys.size();
    sides_.begin_normals();
    for (std::size_t i = 0; i < rows; ++i) {
      const FeaturePairKey& key = keys[std::min(i, keys.size() - 1)];
      a[i] = key.index_a();
      b[i] = key.index_b();
      // Keys with one vertex of a follow each other.
      const bool is_last = i > 0 && a[i] == a[i - 1];
      batch_.normal_a[i] = is_last ? batch_.normal_a[i - 1] : sides_.normal_of_a(pair_, a[i]);
      batch_.normal_b[i] = sides_.normal_of_b(pair_, b[i]);
    }
    put_points(pair_.a, std::span(a).first(rows), batch_.a);
    put_points(pair_.b, std::span(b).first(rows), batch_.b);
    sides_.finish_normals();
  }

  void take(std::size_t i, const FeaturePairKey& key, Contact& contact) {
    const auto found = static_cast<unsigned>(batch_.found[i]);
    if (found == 0) {
      contact = measure_without_sides(pair_, key);
      if (contact.distance == 0) return;
    } else {
      contact = {ContactKind::VV,
                 static_cast<Side>(found >> 2U & 3U),
                 static_cast<Side>(found >> 4U),
                 false,
                 {FeatureKind::vertex, key.index_a()},
                 {FeatureKind::vertex, key.index_b()},
                 Eigen::Map<const Eigen::Vector3d>(batch_.a[i]),
                 Eigen::Map<const Eigen::Vector3d>(batch_.b[i]),
                 Eigen::Map<const Eigen::Vector3d>(batch_.normal[i]),
                 batch_.normal[i][3]};
      if (contact.side_a != Side::none && contact.side_b != Side::none) return;
    }
    contact.side_a = side(*batch_.normal_a[i], pair_.a, contact.feature_a, contact.normal);
    contact.side_b = side(*batch_.normal_b[i], pair_.b, contact.feature_b, -contact.normal);
  }
  [[nodiscard]] Side side(const RoughNormal& normal, const Surface& surface, const Feature& vertex,
                          const Eigen::Vector3d& direction) const {
    const auto known = certain_side(normal, direction);
    return known ? *known : side_of(surface, vertex_piece(vertex.index), direction, pair_.count);
  }

  const SurfacePair& pair_;
  Sides& sides_;
  kernels::VertexBatch& batch_;
};

/// Measures contacts of one shape, as many at once as the kernels take.
class Batch {
 public:
  Batch(const SurfacePair& pair, std::span<const FeaturePairKey> keys, std::span<Contact> contacts,
        MeasureScratch& scratch)
      : pair_(pair), keys_(keys), contacts_(contacts), scratch_(scratch) {}

  void add(std::size_t contact, const Shape& shape) {
    if (shape != shape_ || count_ == kernels::contact_lanes) finish();
    shape_ = shape;
    const FeaturePairKey& key = keys_[contact];
    const bool a_is_low = is_a_low(key);
    put(a_is_low ? pair_.a : pair_.b, a_is_low ? key.a() : key.b(), shape.low, scratch_.batch.low);
    put(a_is_low ? pair_.b : pair_.a, a_is_low ? key.b() : key.a(), shape.high, scratch_.batch.high);
    contact_[count_++] = contact;
  }
  void add_alone(std::size_t contact) {
    measure_alone(pair_, keys_[contact], contacts_[contact], scratch_.sides);
  }
  void finish() {
    if (count_ == 0) return;
    kernel()(scratch_.batch);
    for (std::size_t lane = 0; lane < count_; ++lane) take(lane);
    count_ = 0;
  }

 private:
  static bool is_a_low(const FeaturePairKey& key) { return corner_count(key.a()) <= corner_count(key.b()); }

  void put(const Surface& surface, const FeaturePiece& piece, std::uint32_t corners,
           kernels::Points* points) const {
    const auto vertex = corners_of(surface.mesh(), piece);
    for (std::uint32_t corner = 0; corner < corners; ++corner)
      put_corner(surface, vertex[corner], points[corner], count_);
  }
  [[nodiscard]] kernels::Measure::Kernel kernel() const {
    const kernels::Measure& measure = kernels::measure();
    if (shape_.high == 3) return shape_.low == 1 ? measure.point_and_plane : measure.piercing;
    return shape_.low == 1 ? measure.point_and_line : measure.lines;
  }

  void take(std::size_t lane) {
    const kernels::ContactBatch& batch = scratch_.batch;
    if (batch.certain[lane] == 0) return add_alone(contact_[lane]);
    const FeaturePairKey& key = keys_[contact_[lane]];
    Contact& contact = contacts_[contact_[lane]];
    const bool a_is_low = is_a_low(key);
    const Eigen::Vector3d normal = at(batch.normal, lane);
    contact = {key.kind(),
               Side::none,
               Side::none,
               false,
               key.a().feature,
               key.b().feature,
               at(a_is_low ? batch.low_point : batch.high_point, lane),
               at(a_is_low ? batch.high_point : batch.low_point, lane),
               a_is_low ? normal : Eigen::Vector3d(-normal),
               batch.distance[lane]};
    scratch_.sides.add(pair_, key, contact);
  }

  const SurfacePair& pair_;
  std::span<const FeaturePairKey> keys_;
  std::span<Contact> contacts_;
  MeasureScratch& scratch_;
  Shape shape_;
  std::size_t count_ = 0;
  std::array<std::size_t, kernels::contact_lanes> contact_{};
};

}  // namespace

void measure(const SurfacePair& pair, std::span<const FeaturePairKey> keys, std::span<Contact> contacts,
             MeasureScratch& scratch) {
  scratch.sides.begin();
  // Keys are sorted by kind, and two vertices are the first kind.
  const auto vertices = std::find_if(keys.begin(), keys.end(),
                                     [](const FeaturePairKey& key) { return key.kind() != ContactKind::VV; });
  const auto vertex_count = static_cast<std::size_t>(vertices - keys.begin());
  VertexContacts of_vertices(pair, scratch);
  for (std::size_t i = 0; i < vertex_count; i += kernels::vertices_at_once) {
    pair.check_time(kernels::vertices_at_once / 4);
    of_vertices.measure(keys.subspan(i, std::min(vertex_count - i, kernels::vertices_at_once)), &contacts[i]);
  }
  Batch batch(pair, keys, contacts, scratch);
  for (std::size_t i = vertex_count; i < keys.size(); ++i) {
    pair.check_time();
    const Shape shape = shape_of(keys[i]);
    if (is_for_kernels(keys[i], shape))
      batch.add(i, shape);
    else
      batch.add_alone(i);
  }
  batch.finish();
  scratch.sides.finish(pair);
}

}  // namespace graze
