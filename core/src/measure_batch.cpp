#include "measure_batch.hpp"

#include <algorithm>
#include <array>

#include "corner_lane.hpp"
#include "measure.hpp"

namespace graze {

namespace {

/// How many corners the simplices of a contact have, the lower number first.
struct Shape {
  std::uint32_t low = 0;
  std::uint32_t high = 0;

  friend bool operator==(const Shape&, const Shape&) = default;
};

Shape shape_of(const ContactName& name) {
  const auto [low, high] = std::minmax({corner_count(name.a()), corner_count(name.b())});
  return {low, high};
}

/// A piercing fold is left out since its normal is not the triangle's.
bool is_for_kernels(const ContactName& name, const Shape& shape) {
  if (name.meeting() == Meeting::pierced) return name.kind() == ContactKind::EF;
  return name.meeting() == Meeting::closest && shape.low + shape.high <= 4;
}

Eigen::Vector3d at(const kernels::Points& points, std::size_t lane) {
  return {points[0][lane], points[1][lane], points[2][lane]};
}

void measure_alone(const SurfacePair& pair, const ContactName& name, Contact& contact, Sides& sides) {
  contact = measure_without_sides(pair, name);
  sides.add(pair, name, contact);
}

/// Measures contacts of vertices, as many at once as the kernels take.
void measure_vertices(const SurfacePair& pair, std::span<const ContactName> names, Contact* contact,
                      MeasureScratch& scratch) {
  kernels::ContactBatch& batch = scratch.batch;
  while (!names.empty()) {
    const auto some = names.first(std::min(names.size(), kernels::contact_lanes));
    for (std::size_t lane = 0; lane < some.size(); ++lane) {
      put_corner(pair.a, some[lane].a().feature.index, batch.low[0], lane);
      put_corner(pair.b, some[lane].b().feature.index, batch.high[0], lane);
    }
    kernels::measure().points(batch);
    for (std::size_t lane = 0; lane < some.size(); ++lane, ++contact) {
      const ContactName& name = some[lane];
      if (batch.certain[lane] == 0) {
        measure_alone(pair, name, *contact, scratch.sides);
        continue;
      }
      *contact = {name.kind(),
                  Side::none,
                  Side::none,
                  name.a().feature,
                  name.b().feature,
                  at(batch.low[0], lane),
                  at(batch.high[0], lane),
                  at(batch.normal, lane),
                  batch.distance[lane]};
      scratch.sides.add(pair, name, *contact);
    }
    names = names.subspan(some.size());
  }
}

/// Measures contacts of one shape, as many at once as the kernels take.
class Batch {
 public:
  Batch(const SurfacePair& pair, std::span<const ContactName> names, std::span<Contact> contacts,
        MeasureScratch& scratch)
      : pair_(pair), names_(names), contacts_(contacts), scratch_(scratch) {}

  void add(std::size_t contact, const Shape& shape) {
    if (shape != shape_ || count_ == kernels::contact_lanes) finish();
    shape_ = shape;
    const ContactName& name = names_[contact];
    const bool a_is_low = is_a_low(name);
    put(a_is_low ? pair_.a : pair_.b, a_is_low ? name.a() : name.b(), shape.low, scratch_.batch.low);
    put(a_is_low ? pair_.b : pair_.a, a_is_low ? name.b() : name.a(), shape.high, scratch_.batch.high);
    contact_[count_++] = contact;
  }
  void add_alone(std::size_t contact) {
    measure_alone(pair_, names_[contact], contacts_[contact], scratch_.sides);
  }
  void finish() {
    if (count_ == 0) return;
    kernel()(scratch_.batch);
    for (std::size_t lane = 0; lane < count_; ++lane) take(lane);
    count_ = 0;
  }

 private:
  static bool is_a_low(const ContactName& name) { return corner_count(name.a()) <= corner_count(name.b()); }

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
    const ContactName& name = names_[contact_[lane]];
    Contact& contact = contacts_[contact_[lane]];
    const bool a_is_low = is_a_low(name);
    const Eigen::Vector3d normal = at(batch.normal, lane);
    contact = {name.kind(),
               Side::none,
               Side::none,
               name.a().feature,
               name.b().feature,
               at(a_is_low ? batch.low_point : batch.high_point, lane),
               at(a_is_low ? batch.high_point : batch.low_point, lane),
               a_is_low ? normal : Eigen::Vector3d(-normal),
               batch.distance[lane]};
    scratch_.sides.add(pair_, name, contact);
  }

  const SurfacePair& pair_;
  std::span<const ContactName> names_;
  std::span<Contact> contacts_;
  MeasureScratch& scratch_;
  Shape shape_;
  std::size_t count_ = 0;
  std::array<std::size_t, kernels::contact_lanes> contact_{};
};

}  // namespace

void measure(const SurfacePair& pair, std::span<const ContactName> names, std::span<Contact> contacts,
             MeasureScratch& scratch) {
  scratch.sides.begin();
  // Names are sorted by kind, and that of two vertices is the first.
  const auto vertices = std::find_if(names.begin(), names.end(),
                                     [](const ContactName& name) { return name.kind() != ContactKind::VV; });
  const auto vertex_count = static_cast<std::size_t>(vertices - names.begin());
  measure_vertices(pair, names.first(vertex_count), contacts.data(), scratch);
  Batch batch(pair, names, contacts, scratch);
  for (std::size_t i = vertex_count; i < names.size(); ++i) {
    const Shape shape = shape_of(names[i]);
    if (is_for_kernels(names[i], shape))
      batch.add(i, shape);
    else
      batch.add_alone(i);
  }
  batch.finish();
  scratch.sides.finish(pair);
}

}  // namespace graze
