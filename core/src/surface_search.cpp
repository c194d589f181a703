// Looks for the vertices in a box by going through all of them, without any hierarchy.

#include <algorithm>
#include <graze/surface.hpp>

#include "box_within.hpp"
#include "passes_for.hpp"

namespace graze {

namespace {

/// Vertices whose boxes `find_inside` looks at first; a multiple of what its kernels take at once.
constexpr std::uint32_t stretch = 64;
/// Fewer vertices are gone through as quickly as their boxes are made.
constexpr std::uint32_t least_in_stretches = 8 * stretch;

static_assert(Surface::beyond_found >= kernels::lanes);

}  // namespace

void Surface::box_stretches() {
  const std::uint32_t count = mesh_->vertex_count();
  if (count < least_in_stretches || count > most_searched || stretches_version_ == version_) return;
  stretches_version_ = version_;
  stretches_.clear();
  for (std::uint32_t begin = 0; begin < count; begin += stretch) {
    const std::uint32_t end = std::min(begin + stretch, count);
    Box& box = stretches_.emplace_back();
    if (in_double_.empty()) {
      Eigen::Vector3f low;
      Eigen::Vector3f high;
      passes_for<float>().extent(in_float_.front().data(), begin, end, low.data(), high.data());
      box = {low.cast<double>(), high.cast<double>()};
    } else {
      passes_for<double>().extent(in_double_.front().data(), begin, end, box.min.data(), box.max.data());
    }
  }
}

std::size_t Surface::find_inside(const Box& box, std::span<std::uint32_t> found) const {
  const std::uint32_t count = mesh_->vertex_count();
  const BoxWithin<float> in_float(box);
  std::size_t inside = 0;
  const auto pass = [&](std::uint32_t begin, std::uint32_t end) {
    std::uint32_t* const places = found.data() + inside;
    inside += in_double_.empty()
                  ? passes_for<float>().inside(in_float_.front().data(), begin, end, in_float.low.data(),
                                               in_float.high.data(), places)
                  : passes_for<double>().inside(in_double_.front().data(), begin, end, box.min.data(),
                                                box.max.data(), places);
  };
  if (stretches_version_ != version_) {
    pass(0, count);
  } else {
    // Stretches that follow one another go in one pass, since each has to be begun.
    for (std::uint32_t i = 0; i < stretches_.size(); ++i) {
      const std::uint32_t first = i;
      while (i < stretches_.size() && !common(stretches_[i], box).empty()) ++i;
      if (i > first) pass(first * stretch, std::min(i * stretch, count));
    }
  }
  if (mesh_->uses_all_vertices()) return inside;
  const auto unused = [this](std::uint32_t vertex) { return !mesh_->is_used(vertex); };
  const auto listed = found.first(inside);
  return static_cast<std::size_t>(std::remove_if(listed.begin(), listed.end(), unused) - listed.begin());
}

}  // namespace graze
