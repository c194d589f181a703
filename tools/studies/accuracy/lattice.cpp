#include "accuracy/lattice.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace graze::tools {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

/// -size to size.
double whole_number(Random& random, double size) {
  return std::floor(random.between(-size, size + 1));
}

Vector3d whole_vector(Random& random, double size) {
  const double x = whole_number(random, size);
  const double y = whole_number(random, size);
  return {x, y, whole_number(random, size)};
}

}  // namespace

Lattice::Lattice(Random& random, double longest, double shortest)
    : random_(random), longest_(longest), shortest_(shortest), step_(0x1p-6 / longest) {
  do {
    u_ = whole_vector(random, 64);
    v_ = whole_vector(random, 64);
    w_ = whole_vector(random, 64);
  } while (u_.cross(v_).dot(w_) == 0);
}

double Lattice::i() {
  return whole_number(random_, longest_);
}

double Lattice::j() {
  return whole_number(random_, shortest_);
}

Shape Lattice::flat_face(bool quad, double k) {
  Shape shape;
  for (int corner = 0; corner < 3; ++corner) {
    const double along = i();
    shape.positions.push_back(at(along, j(), k));
  }
  shape.faces = {{0, 1, 2}};
  if (!quad) return shape;
  shape.faces = {{0, 1, 2, 3}};
  const double along = i();
  shape.positions.push_back(random_.chance(0.7)
                                ? shape.positions[0] + (shape.positions[2] - shape.positions[1])
                                : at(along, j(), k));
  return shape;
}

Shape Lattice::face_on_edge(double k) {
  Shape shape = flat_face(false, k);
  shape.positions[2] += 3 * (at(0, 0, k) - at(0, 0, 0));
  return shape;
}

std::array<Shape, 2> parallel_shapes(Random& random, bool needles, bool apart) {
  Lattice lattice = needles ? Lattice(random, std::ldexp(1.0, static_cast<int>(10 + random.below(20))), 1)
                            : Lattice(random, 64, 64);
  const double height = apart ? 1 + random.below(needles ? 4 : 64) : 0;
  const std::uint32_t form = random.below(4);
  if (form == 0) {  // two edges
    Shape a, b;
    const double low = -height - 1;
    a.positions = {lattice.at(lattice.i(), 0, 0), lattice.at(lattice.i(), 0, 0),
                   lattice.at(0, lattice.j(), low)};
    const double j = apart ? lattice.j() : 0;
    const double high = 2 * height + 1;
    b.positions = {lattice.at(lattice.i(), j, height), lattice.at(lattice.i(), j, height),
                   lattice.at(0, lattice.j(), high)};
    a.faces = b.faces = {{0, 1, 2}};
    return {a, b};
  }
  const Shape a = lattice.flat_face(random.chance(0.5), 0);
  if (form == 1) {  // an edge over a face
    Shape b = lattice.face_on_edge(height);
    if (!apart) b.positions[2] += lattice.at(0, 0, 3);
    return random.chance(0.5) ? std::array{a, b} : std::array{b, a};
  }
  return {a, lattice.flat_face(random.chance(0.5), height)};
}

Shape collapsed_face(Random& random) {
  Lattice lattice(random, 64, 64);
  Shape shape = lattice.flat_face(random.chance(0.3), 0);
  std::vector<std::uint32_t>& face = shape.faces[0];
  switch (random.below(4)) {
    case 0:  // collinear
      for (Vector3d& corner : shape.positions) corner = lattice.at(lattice.i(), 0, 0);
      break;
    case 1:  // two vertices in one place
      shape.positions[1] = shape.positions[0];
      break;
    case 2:  // one vertex used twice
      face[1] = face[0];
      break;
    default:  // a single point
      for (Vector3d& corner : shape.positions) corner = shape.positions[0];
  }
  return shape;
}

std::array<Shape, 2> touching_shapes(Random& random) {
  Lattice lattice(random, 64, 64);
  const Shape a = lattice.flat_face(random.chance(0.3), 0);
  Shape b = lattice.flat_face(random.chance(0.3), 0);
  for (std::size_t i = 1; i < b.positions.size(); ++i)
    b.positions[i] += lattice.at(0, 0, 1 + random.below(9));
  const Vector3d& p = a.positions[0];
  const Vector3d& q = a.positions[1];
  const Vector3d& r = a.positions[2];
  const std::array<Vector3d, 3> places = {p, 0.5 * (p + q), 0.5 * p + 0.25 * (q + r)};
  const Vector3d offset = places[random.below(3)] - b.positions[0];
  for (Vector3d& corner : b.positions) corner += offset;
  return {a, b};
}

}  // namespace graze::tools
