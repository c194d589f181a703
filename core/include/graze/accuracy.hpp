#pragma once

#include <graze/export.hpp>
#include <initializer_list>
#include <vector>

namespace graze {

enum class AccuracyMode : unsigned char { exact, within, paper };

/// How exact the answers of a scene are.
class GRAZE_API Accuracy {
 public:
  /// Contacts, phases and distances are those of real arithmetic.
  static Accuracy exact();

  /// The distance of a pair that is not in contact may be up to `tolerance` loose between its bounds;
  /// contacts and phases stay exact. Throws Error unless `tolerance` is finite and not negative.
  static Accuracy within(double tolerance);

  /// The paper's own test (eq. 4): regions are expanded while their middle vertices are closer than the
  /// level's number; the last number is DV's threshold in place of the contact distance. Without numbers the
  /// levels' come from eq. 3 summed as in eq. 6, and DV's is the contact distance. Throws Error for a number
  /// that is negative or not finite.
  static Accuracy paper(std::vector<double> epsilon = {});
  static Accuracy paper(std::initializer_list<double> epsilon);

  [[nodiscard]] AccuracyMode mode() const { return mode_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  [[nodiscard]] const std::vector<double>& epsilon() const { return epsilon_; }

 private:
  AccuracyMode mode_ = AccuracyMode::exact;
  double tolerance_ = 0;
  std::vector<double> epsilon_;
};

}  // namespace graze
