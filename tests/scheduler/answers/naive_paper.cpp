#include "scheduler/answers/naive_paper.hpp"

#include <algorithm>
#include <set>

namespace graze::tests {

NaivePaper::Tree::Tree(const oracle::Shape& rest, const std::vector<Eigen::Vector3d>& positions)
    : regions(oracle::regions_of(rest)),
      children(regions.size()),
      neighbours(positions.size()),
      level_radii(oracle::level_radii(regions, positions)),
      now(positions) {
  for (std::size_t parent = 0; parent < regions.size(); ++parent)
    for (std::size_t child = 0; child < regions.size(); ++child)
      if (regions[child].level == regions[parent].level + 1 && !regions[parent].leaf &&
          std::binary_search(regions[parent].vertices.begin(), regions[parent].vertices.end(),
                             regions[child].vertices[0]))
        children[parent].push_back(child);
  for (const auto& [from, to] : oracle::edges_of(rest)) {
    neighbours[from].push_back(to);
    neighbours[to].push_back(from);
  }
}

/// A region's children. A leaf stays itself.
std::vector<std::size_t> NaivePaper::Tree::expanded(std::size_t region) const {
  return regions[region].leaf ? std::vector{region} : children[region];
}

class NaivePaper::Search {
 public:
  Search(const Tree& a, const Tree& b, const std::vector<double>& epsilon, double threshold, bool every_pair)
      : a_(a), b_(b), epsilon_(epsilon), threshold_(threshold), every_pair_(every_pair) {}

  Found run() {
    visit(0, 0, 0);
    return {{contacts_.begin(), contacts_.end()}, leaf_pairs_};
  }

 private:
  [[nodiscard]] PaperContact pair_of(std::uint32_t a, std::uint32_t b) const {
    return {a, b, (a_.now[a] - b_.now[b]).norm()};
  }

  void visit(std::size_t a, std::size_t b, std::size_t level) {
    if (a_.regions[a].leaf && b_.regions[b].leaf) return at_leaves(a, b);
    const PaperContact middles = pair_of(a_.regions[a].middle, b_.regions[b].middle);
    if (level > 0 && !(middles.distance < epsilon_of(a, b, level))) return;
    for (const std::size_t child_a : a_.expanded(a))
      for (const std::size_t child_b : b_.expanded(b)) visit(child_a, child_b, level + 1);
  }

  [[nodiscard]] double epsilon_of(std::size_t a, std::size_t b, std::size_t level) const {
    if (epsilon_.empty()) return a_.level_radii[a_.regions[a].level] + b_.level_radii[b_.regions[b].level];
    const std::size_t last = std::max<std::size_t>(epsilon_.size(), 2) - 1;
    return epsilon_[std::min(level, last) - 1];
  }

  void at_leaves(std::size_t a, std::size_t b) {
    ++leaf_pairs_;
    std::vector<PaperContact> all;
    for (const std::uint32_t vertex_a : a_.regions[a].vertices)
      for (const std::uint32_t vertex_b : b_.regions[b].vertices) all.push_back(pair_of(vertex_a, vertex_b));
    if (every_pair_)
      for (const PaperContact& contact : all) add(contact);
    else
      add(walked_from(nearest_of(all)));
  }

  /// DV: on to the nearest pair of neighbours while that is nearer.
  [[nodiscard]] PaperContact walked_from(PaperContact at) const {
    for (;;) {
      std::vector<std::uint32_t> around_a = a_.neighbours[at.a];
      std::vector<std::uint32_t> around_b = b_.neighbours[at.b];
      around_a.push_back(at.a);
      around_b.push_back(at.b);
      std::vector<PaperContact> all;
      for (const std::uint32_t to_a : around_a)
        for (const std::uint32_t to_b : around_b) all.push_back(pair_of(to_a, to_b));
      const PaperContact next = nearest_of(all);
      if (!(next.distance < at.distance)) return at;
      at = next;
    }
  }

  static PaperContact nearest_of(const std::vector<PaperContact>& all) {
    return *std::min_element(all.begin(), all.end(), [](const PaperContact& left, const PaperContact& right) {
      return left.distance < right.distance;
    });
  }

  void add(const PaperContact& contact) {
    if (contact.distance < threshold_) contacts_.insert(contact);
  }

  const Tree& a_;
  const Tree& b_;
  const std::vector<double>& epsilon_;
  double threshold_;
  bool every_pair_;
  std::set<PaperContact> contacts_;
  std::size_t leaf_pairs_ = 0;
};

NaivePaper::NaivePaper(const oracle::Shape& rest_a, const oracle::Shape& rest_b,
                       const std::vector<Eigen::Vector3d>& now_a, const std::vector<Eigen::Vector3d>& now_b)
    : a_(rest_a, now_a), b_(rest_b, now_b) {}

NaivePaper::Found NaivePaper::find(const std::vector<double>& epsilon, double threshold,
                                   bool every_pair) const {
  return Search(a_, b_, epsilon, threshold, every_pair).run();
}

}  // namespace graze::tests
