#include <cmath>
#include <graze/accuracy.hpp>
#include <graze/error.hpp>
#include <string>
#include <utility>

#include "core/base/number_text.hpp"

namespace graze {
namespace {

void check_distance(double value, const char* what) {
  if (!std::isfinite(value) || value < 0)
    throw Error(std::string(what) + " is " + number_text(value) +
                "; give a finite distance that is not negative");
}

}  // namespace

Accuracy Accuracy::exact() {
  return {};
}

Accuracy Accuracy::within(double tolerance) {
  check_distance(tolerance, "Accuracy::within: the tolerance");
  Accuracy accuracy;
  accuracy.mode_ = AccuracyMode::within;
  accuracy.tolerance_ = tolerance;
  return accuracy;
}

Accuracy Accuracy::paper(std::vector<double> epsilon) {
  for (const double value : epsilon) check_distance(value, "Accuracy::paper: an epsilon");
  Accuracy accuracy;
  accuracy.mode_ = AccuracyMode::paper;
  accuracy.epsilon_ = std::move(epsilon);
  return accuracy;
}

Accuracy Accuracy::paper(std::initializer_list<double> epsilon) {
  return paper(std::vector<double>(epsilon));
}

}  // namespace graze
