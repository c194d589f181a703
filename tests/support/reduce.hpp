#pragma once

#include <functional>
#include <string>

#include "support/oracle/oracle.hpp"

namespace graze::tests {

/// Two surfaces and a threshold.
struct TwoShapes {
  oracle::Shape a, b;
  double threshold = 0;
};

/// Describes a fault of a scene. Empty if it has none. Two texts that differ only in numbers describe one
/// kind of fault.
using Judge = std::function<std::string(const TwoShapes&)>;

/// A small scene of which `judge` says the same kind of thing as of `scene`: no face, vertex or digit can be
/// dropped, and no number made simpler, by itself. Calls `judge` some hundred or thousand times. Both shapes
/// keep a face. A scene of which nothing is wrong comes back as it is.
TwoShapes reduced(TwoShapes scene, const Judge& judge);

/// C++ that makes the scene: `const oracle::Shape a = …;`, the same for b, and `const double threshold = …;`.
std::string text_of(const TwoShapes& scene);

/// For a failing test: the scene as it is reduced, in C++, and what `judge` says of it. Empty where nothing
/// is wrong.
std::string reduced_text(const TwoShapes& scene, const Judge& judge);

}  // namespace graze::tests
