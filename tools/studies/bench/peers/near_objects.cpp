#include "bench/peers/near_objects.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace graze::bench {

NearObjects::NearObjects(const World& world, Workers& workers)
    : world_(world),
      workers_(workers),
      versions_(world.objects.size()),
      boxes_(world.objects.size()),
      grown_(world.objects.size()),
      cell_of_(world.objects.size()),
      sorted_(world.objects.size()),
      is_near_(world.objects.size()) {}

void NearObjects::update_boxes() {
  constexpr std::size_t block = 64;
  const std::size_t count = boxes_.size();
  const auto update = [&](std::size_t i) {
    if (versions_[i] == world_.versions[i]) return;
    versions_[i] = world_.versions[i];
    boxes_[i] = box_of(world_.positions_of(i), world_.objects[i].vertex_count);
    grown_[i] = grown(boxes_[i], world_.distance);
  };
  workers_.each((count + block - 1) / block, [&](std::size_t k, std::size_t) {
    for (std::size_t i = k * block; i < std::min(count, (k + 1) * block); ++i) update(i);
  });
}

void NearObjects::sort_into_cells() {
  constexpr float most_cells = 64;  // along each axis
  FloatBox all;
  float largest = 0;
  for (const FloatBox& box : grown_) {
    all.add(box);
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, box.max[axis] - box.min[axis]);
  }
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max(largest, (all.max[axis] - all.min[axis]) / most_cells);
  cell_ = largest * 1.0001F;
  for (int axis = 0; axis < 3; ++axis) {
    corner_[axis] = all.min[axis];
    cells_[axis] = static_cast<std::uint32_t>((all.max[axis] - all.min[axis]) / cell_) + 1;
  }
  const std::size_t cells = std::size_t{cells_[0]} * cells_[1] * cells_[2];
  cell_begin_.assign(cells + 1, 0);
  for (std::size_t i = 0; i < grown_.size(); ++i) {
    std::uint32_t cell[3];
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = std::min(static_cast<std::uint32_t>((grown_[i].min[axis] - corner_[axis]) / cell_),
                            cells_[axis] - 1);
    cell_of_[i] = (cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0];
    ++cell_begin_[cell_of_[i] + 1];
  }
  for (std::size_t i = 0; i < cells; ++i) cell_begin_[i + 1] += cell_begin_[i];
  for (std::size_t i = grown_.size(); i-- > 0;)
    sorted_[--cell_begin_[cell_of_[i] + 1]] = static_cast<std::uint32_t>(i);
  // Every begin has come to stand one place too late.
  std::rotate(cell_begin_.begin(), cell_begin_.begin() + 1, cell_begin_.end());
  cell_begin_.back() = static_cast<std::uint32_t>(grown_.size());
}

void NearObjects::find_pairs_of(std::size_t place) {
  const std::uint32_t object = sorted_[place];
  const std::uint32_t cell = cell_of_[object];
  const std::uint32_t x = cell % cells_[0];
  const std::uint32_t y = cell / cells_[0] % cells_[1];
  const std::uint32_t z = cell / cells_[0] / cells_[1];
  const auto test = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t other = sorted_[i];
      if (!grown_[object].meets(boxes_[other])) continue;
      if (world_.objects[object].is_fixed && world_.objects[other].is_fixed) continue;
      pairs_.push_back({std::min(object, other), std::max(object, other)});
    }
  };
  // The rest of its own row of cells, and three cells of each row that comes later.
  test(place + 1, cell_begin_[cell + (x + 1 < cells_[0] ? 2 : 1)]);
  constexpr std::pair<int, int> later_rows[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  for (const auto& [dy, dz] : later_rows) {
    if ((dy < 0 && y == 0) || (dy > 0 && y + 1 == cells_[1]) || (dz > 0 && z + 1 == cells_[2])) continue;
    const std::uint32_t row =
        ((z + static_cast<std::uint32_t>(dz)) * cells_[1] + y + static_cast<std::uint32_t>(dy)) * cells_[0];
    const std::uint32_t first = x > 0 ? x - 1 : 0;
    const std::uint32_t last = std::min(x + 1, cells_[0] - 1);
    test(cell_begin_[row + first], cell_begin_[row + last + 1]);
  }
}

void NearObjects::update() {
  update_boxes();
  sort_into_cells();
  pairs_.clear();
  for (std::size_t place = 0; place < sorted_.size(); ++place) find_pairs_of(place);
  std::fill(is_near_.begin(), is_near_.end(), 0);
  for (const ObjectPair& pair : pairs_) is_near_[pair.a] = is_near_[pair.b] = 1;
  near_.clear();
  for (std::uint32_t i = 0; i < is_near_.size(); ++i)
    if (is_near_[i] != 0) near_.push_back(i);
}

}  // namespace graze::bench
