#pragma once

#include <graze/contact.hpp>
#include <optional>

#include "accuracy/kernels.hpp"
#include "support/comparison.hpp"
#include "support/oracle/oracle_features.hpp"

namespace graze::tools {

/// Two surfaces in exact coordinates, against which single contacts are measured.
class ContactMeter {
 public:
  ContactMeter(const oracle::Shape& a, const oracle::Shape& b);

  [[nodiscard]] const oracle::ExactShape& a() const { return a_; }
  [[nodiscard]] const oracle::ExactShape& b() const { return b_; }

  /// Adds the errors of a contact whose true values are `truth`.
  void add(const Contact& contact, const oracle::ExactContact& truth, KernelErrors& errors) const;

 private:
  void add_normal(const Contact& contact, const oracle::ExactContact& truth, KernelErrors& errors) const;

  oracle::ExactShape a_;
  oracle::ExactShape b_;
  tests::Tolerance tolerance_;
};

}  // namespace graze::tools
