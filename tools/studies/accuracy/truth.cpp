#include "accuracy/truth.hpp"

#include <algorithm>

namespace graze::tools {
namespace {

class Checker {
 public:
  Checker(const MovingModels& models, const ModeStudy& study, std::uint32_t frame, TruthCheck& check)
      : study_(study), frame_(frame), check_(check) {
    for (std::size_t body = 0; body < models.size(); ++body) {
      shapes_.push_back(models.shape(body, frame));
      rests_.push_back(models.rest(body));
    }
  }

  /// Pairs are in the order in which the models were added, each listed.
  void check_frame(std::uint32_t every) {
    std::size_t row = 0;
    for (std::size_t a = 0; a < shapes_.size(); ++a)
      for (std::size_t b = a + 1; b < shapes_.size(); ++b, ++row)
        if (check_.pair_rows++ % every == 0) check_pair(a, b, row);
  }

 private:
  void check_pair(std::size_t a, std::size_t b, std::size_t row) {
    const oracle::Shape& shape_a = shapes_[a];
    const oracle::Shape& shape_b = shapes_[b];
    const double threshold = study_.contact_distance();
    ++check_.checked;
    check_contacts(ContactDetail::features, row, oracle::features(shape_a, shape_b, threshold));
    check_contacts(ContactDetail::vertices, row, oracle::vertices(shape_a, shape_b, threshold));
    check_contacts(ContactDetail::regions, row,
                   oracle::regions(shape_a, shape_b, threshold, rests_[a], rests_[b]));
    check_bounds(ContactDetail::features, row, oracle::surface_distance(shape_a, shape_b));
    check_bounds(ContactDetail::vertices, row, oracle::vertex_distance(shape_a, shape_b));
  }

  void check_contacts(ContactDetail detail, std::size_t row, const std::vector<oracle::Named>& expected) {
    const FrameReport& report = *study_.truth(detail)[frame_];
    const auto contacts = report.contacts(report.pairs()[row]);
    check_.contacts += expected.size();
    const bool equal =
        std::ranges::equal(contacts, expected, [](const Contact& contact, const oracle::Named& named) {
          return contact.kind == named.kind && contact.feature_a == named.a && contact.feature_b == named.b;
        });
    check_.wrong += equal ? 0U : 1U;
  }

  void check_bounds(ContactDetail detail, std::size_t row, const oracle::Pair& expected) {
    const DistanceBounds& found = study_.truth(detail)[frame_]->pairs()[row].distance;
    check_.wrong += found.lower == expected.distance_down && found.upper == expected.distance_up ? 0U : 1U;
  }

  const ModeStudy& study_;
  std::uint32_t frame_;
  TruthCheck& check_;
  std::vector<oracle::Shape> shapes_, rests_;
};

}  // namespace

TruthCheck check_truth(const MovingModels& models, const ModeStudy& study, std::uint32_t every) {
  TruthCheck check;
  for (std::uint32_t frame = 0; frame < models.frame_count(); ++frame)
    Checker(models, study, frame, check).check_frame(every);
  return check;
}

}  // namespace graze::tools
