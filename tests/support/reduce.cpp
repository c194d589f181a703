#include "support/reduce.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace graze::tests {
namespace {

using oracle::Shape;

/// The text without its numbers.
std::string kind_of(const std::string& difference) {
  std::string kind;
  bool in_number = false;
  for (const char c : difference.substr(0, difference.find('\n'))) {
    const bool is_digit = c >= '0' && c <= '9';
    in_number = is_digit || c == '.' || c == '-' || c == '+' || (in_number && c == 'e');
    if (!in_number) kind += c;
  }
  return kind;
}

/// How much there is to a number: 0 for 0, 1 for 1, more for every binary digit and for every power of two by
/// which its last digit is off the units.
int complexity(double number) {
  if (number == 0) return 0;
  if (!std::isfinite(number)) return 100000;
  int exponent = 0;
  double digits = std::frexp(std::abs(number), &exponent);
  int count = 0;
  while (digits != 0) {
    digits = 2 * digits - std::floor(2 * digits);
    ++count;
  }
  return 2 * (count + std::abs(exponent - count)) + (number < 0 ? 1 : 0);
}

/// Numbers near `number` that are simpler, the simplest first.
std::vector<double> simpler(double number) {
  std::vector<double> candidates = {0, 1, 2};
  if (std::isfinite(number)) {
    candidates.push_back(-number);
    int exponent = 0;
    std::frexp(number, &exponent);
    for (int digits = 1; digits < 53; ++digits) {
      const double scaled = std::ldexp(number, digits - exponent);
      candidates.push_back(std::ldexp(std::round(scaled), exponent - digits));
      candidates.push_back(std::ldexp(std::trunc(scaled), exponent - digits));
    }
    for (int scale = 1 << 10; scale > 0; scale /= 2)
      for (const double factor : {std::ldexp(1.0, scale), std::ldexp(1.0, -scale)})
        candidates.push_back(number * factor);
  }
  std::erase_if(candidates, [&](double c) { return complexity(c) >= complexity(number); });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](double a, double b) { return complexity(a) < complexity(b); });
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  return candidates;
}

void drop_unused_vertices(Shape& shape) {
  std::vector<std::uint32_t> number(shape.positions.size(), 0);
  for (const auto& face : shape.faces)
    for (const std::uint32_t corner : face) number[corner] = 1;
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t vertex = 0; vertex < number.size(); ++vertex)
    if (number[vertex] != 0) {
      number[vertex] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(shape.positions[vertex]);
    }
  shape.positions = std::move(kept);
  for (auto& face : shape.faces)
    for (std::uint32_t& corner : face) corner = number[corner];
}

class Reducer {
 public:
  Reducer(TwoShapes scene, const Judge& judge)
      : scene_(std::move(scene)), judge_(judge), kind_(kind_of(judge(scene_))) {}

  TwoShapes run() {
    if (kind_.empty()) return scene_;
    do {
      changed_ = false;
      for (const auto shape : {&TwoShapes::a, &TwoShapes::b}) {
        drop_faces(shape);
        cut_quads(shape);
        keep_if_same([&](TwoShapes& scene) { drop_unused_vertices(scene.*shape); },
                     [&](const TwoShapes& scene) {
                       return (scene.*shape).positions.size() < (scene_.*shape).positions.size();
                     });
      }
      simplify_numbers();
    } while (changed_);
    return scene_;
  }

 private:
  using Part = Shape TwoShapes::*;

  /// Takes the scene as `change` makes it where it is worth it and still wrong in the same way.
  template <typename Change, typename IsWorth>
  bool keep_if_same(Change change, IsWorth is_worth) {
    TwoShapes candidate = scene_;
    change(candidate);
    if (!is_worth(candidate) || kind_of(judge_(candidate)) != kind_) return false;
    scene_ = std::move(candidate);
    changed_ = true;
    return true;
  }
  template <typename Change>
  bool keep_if_same(Change change) {
    return keep_if_same(change, [](const TwoShapes&) { return true; });
  }

  /// Runs of faces, shorter and shorter ones. The last face stays.
  void drop_faces(Part part) {
    for (std::size_t length = (scene_.*part).faces.size() / 2; length > 0; length /= 2)
      for (std::size_t begin = 0; begin < (scene_.*part).faces.size();) {
        const std::size_t count = (scene_.*part).faces.size();
        const std::size_t end = std::min(begin + length, count);
        const bool dropped = end - begin < count && keep_if_same([&](TwoShapes& scene) {
                               auto& faces = (scene.*part).faces;
                               faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(begin),
                                           faces.begin() + static_cast<std::ptrdiff_t>(end));
                             });
        if (!dropped) begin = end;
      }
  }

  void cut_quads(Part part) {
    for (std::size_t face = 0; face < (scene_.*part).faces.size(); ++face)
      for (std::ptrdiff_t corner = 0; corner < 4 && (scene_.*part).faces[face].size() == 4; ++corner)
        keep_if_same([&](TwoShapes& scene) {
          auto& corners = (scene.*part).faces[face];
          corners.erase(corners.begin() + corner);
        });
  }

  void simplify_numbers() {
    simplify([](TwoShapes& scene) -> double& { return scene.threshold; });
    for (const Eigen::Index axis : {0, 1, 2}) {
      move_to_zero(axis);
      for (const Part part : {&TwoShapes::a, &TwoShapes::b})
        for (std::size_t vertex = 0; vertex < (scene_.*part).positions.size(); ++vertex)
          simplify([=](TwoShapes& scene) -> double& { return (scene.*part).positions[vertex][axis]; });
    }
  }

  template <typename NumberOf>
  void simplify(NumberOf number_of) {
    for (const double candidate : simpler(number_of(scene_)))
      if (keep_if_same([&](TwoShapes& scene) { number_of(scene) = candidate; })) return;
  }

  /// The whole scene along an axis, so that its first vertex comes to 0 there, where that makes it simpler.
  void move_to_zero(Eigen::Index axis) {
    const double offset = scene_.a.positions[scene_.a.faces[0][0]][axis];
    if (offset == 0 || !std::isfinite(offset)) return;
    keep_if_same(
        [&](TwoShapes& scene) {
          for (const Part part : {&TwoShapes::a, &TwoShapes::b})
            for (Eigen::Vector3d& position : (scene.*part).positions) position[axis] -= offset;
        },
        [&](const TwoShapes& scene) { return total(scene, axis) < total(scene_, axis); });
  }

  static long total(const TwoShapes& scene, Eigen::Index axis) {
    long sum = 0;
    for (const Shape* shape : {&scene.a, &scene.b})
      for (const Eigen::Vector3d& position : shape->positions) sum += complexity(position[axis]);
    return sum;
  }

  TwoShapes scene_;
  const Judge& judge_;
  std::string kind_;
  bool changed_ = false;
};

/// The shortest decimals that are this number, as C++.
std::string number_text(double number) {
  if (std::isnan(number)) return "std::nan(\"\")";
  if (std::isinf(number)) return number > 0 ? "HUGE_VAL" : "-HUGE_VAL";
  std::array<char, 32> digits;
  const auto* const end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), static_cast<std::size_t>(end - digits.data())};
}

template <typename List, typename TextOf>
std::string list_text(const List& list, TextOf text) {
  std::string all = "{";
  for (const auto& entry : list) all += (all.size() > 1 ? ", " : "") + text(entry);
  return all + "}";
}

std::string shape_text(const Shape& shape) {
  const auto point_text = [](const Eigen::Vector3d& p) { return list_text(p, number_text); };
  const auto face_text = [](const std::vector<std::uint32_t>& face) {
    return list_text(face, [](std::uint32_t corner) { return std::to_string(corner); });
  };
  return "{" + list_text(shape.positions, point_text) + ",\n    " + list_text(shape.faces, face_text) + "}";
}

}  // namespace

TwoShapes reduced(TwoShapes scene, const Judge& judge) {
  return Reducer(std::move(scene), judge).run();
}

std::string text_of(const TwoShapes& scene) {
  return "const oracle::Shape a = " + shape_text(scene.a) +
         ";\nconst oracle::Shape b = " + shape_text(scene.b) +
         ";\nconst double threshold = " + number_text(scene.threshold) + ";\n";
}

std::string reduced_text(const TwoShapes& scene, const Judge& judge) {
  if (judge(scene).empty()) return "";
  const TwoShapes small = reduced(scene, judge);
  return text_of(small) + judge(small);
}

}  // namespace graze::tests
