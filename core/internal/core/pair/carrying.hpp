#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <span>
#include <vector>

#include "core/base/bytes_of.hpp"

namespace graze {

/// How many contacts are chosen to carry a pair, and among which.
struct CarryingRule {
  std::size_t most = 1;  ///< at least 1
  double band = 0;       ///< how much less deep than the deepest they may be
};

/// Chooses the contacts of ContactDetail::nearest that carry a pair, as docs/answers.md says. It keeps its
/// working memory. One thread at a time.
class GRAZE_API CarryingChoice {
 public:
  /// Leaves only the chosen ones of a pair's contacts, in their order. `last` are those that the last report
  /// lists of the pair. Both are sorted by kind, feature a, feature b. Returns whether a higher number would
  /// leave more.
  bool choose(std::vector<Contact>& contacts, std::span<const Contact> last, const CarryingRule& rule);
  /// Makes room for pairs of so many contacts.
  void reserve(std::size_t contacts);
  void reserve_as(const CarryingChoice& other) {
    reserve(std::max(other.candidates_.capacity(), other.lost_.capacity()));
  }
  [[nodiscard]] std::size_t byte_count() const {
    return bytes_of(candidates_) + bytes_of(lost_) + bytes_of(places_) + bytes_of(outline_);
  }

 private:
  using Place = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;

  /// A contact that may be chosen.
  struct Candidate {
    std::uint32_t index = 0;   ///< of the contact
    bool was_listed = false;   ///< in the last report
    bool is_directed = false;  ///< pushes as the first leader does
    bool is_covered = false;   ///< pushes as some leader does
    bool is_chosen = false;
    double separation = 0;
    double worth = 1;             ///< 1 for the deepest, 0 at the end of the band
    Place place = Place::Zero();  ///< in the plane square to the push
    double distance = 0;          ///< from what is chosen
    [[nodiscard]] double gain() const { return worth * distance; }
  };

  void collect(std::span<const Contact> contacts);
  void find_listed(std::span<const Contact> contacts, std::span<const Contact> last);
  void keep_band(double band);
  [[nodiscard]] Candidate* find_leader(std::span<const Contact> contacts, double band);
  void find_places(std::span<const Contact> contacts, const Candidate& leader);
  void add_other_directions(std::span<const Contact> contacts, const CarryingRule& rule);
  void cover(std::span<const Contact> contacts, const Candidate& leader);
  void spread(std::size_t most);
  [[nodiscard]] Candidate* find_next(double least_gain);
  void add(Candidate& candidate);
  void find_outline();

  std::vector<Candidate> candidates_;  ///< in the order of the contacts
  std::vector<std::uint32_t> lost_;    ///< contacts of the last report that are not there any more
  std::size_t chosen_ = 0;
  std::vector<Place> places_;   ///< of those chosen, sorted, each once
  std::vector<Place> outline_;  ///< the convex hull of the places, counter-clockwise
};

}  // namespace graze
