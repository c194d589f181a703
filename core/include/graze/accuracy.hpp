#pragma once

#include <graze/export.hpp>
#include <initializer_list>
#include <vector>

namespace graze {

/// @addtogroup settings
/// @{

/// The three ways to be exact, see Accuracy.
enum class AccuracyMode : unsigned char {
  exact,   ///< Contacts, phases and distances are those of real arithmetic.
  within,  ///< Distances of pairs that are not in contact may be loose.
  paper,   ///< Regions are expanded by the test of the paper, its equation 4.
};

/// Says how exact the answers of a scene are. The default is exact().
class GRAZE_API Accuracy {
 public:
  /// Asks for contacts, phases and distances as in real arithmetic. The bounds of a distance are the true
  /// distance, rounded down and up.
  static Accuracy exact();

  /// Lets the bounds of the distance of a pair that is not in contact be up to `tolerance` apart. Contacts
  /// and phases stay exact. `tolerance` is a length in the caller's units. Throws Error unless it is finite
  /// and not negative.
  static Accuracy within(double tolerance);

  /// Asks for the paper's own test, its equation 4. It goes with the details `regions` and `vertices` only.
  ///
  /// Both regions of a pair are expanded while their middle vertices are closer than the number of their
  /// level. If one of them is a leaf, only the other is expanded. All pairs of level 1 are tested in every
  /// step. `epsilon` has a number for each level from 1 on, and a last one for the leaves. The last number of
  /// a level also counts for the deeper levels. The number for the leaves replaces the contact distance in
  /// the paper's DV.
  ///
  /// Without numbers, a level's number is the sum of both objects' level radii (equations 3 and 6 of the
  /// paper). DV then uses the contact distance. Throws Error for a number that is negative or not finite.
  static Accuracy paper(std::vector<double> epsilon = {});
  /// Asks for the paper's own test with numbers in braces, such as `Accuracy::paper({24, 14, 8})`.
  static Accuracy paper(std::initializer_list<double> epsilon);

  /// Returns which of the three ways this is.
  [[nodiscard]] AccuracyMode mode() const { return mode_; }
  /// Returns the tolerance of within(), and 0 for the other ways.
  [[nodiscard]] double tolerance() const { return tolerance_; }
  /// Returns the numbers of paper(), which may be none. It is empty for the other ways.
  [[nodiscard]] const std::vector<double>& epsilon() const { return epsilon_; }

 private:
  AccuracyMode mode_ = AccuracyMode::exact;
  double tolerance_ = 0;
  std::vector<double> epsilon_;
};

/// @}

}  // namespace graze
