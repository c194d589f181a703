#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/report.hpp>
#include <memory>
#include <vector>

#include "base/kept_by_reports.hpp"
#include "base/task_pool.hpp"
#include "broad_phase/box_order.hpp"
#include "geometry/kept_geometry.hpp"
#include "geometry/spare_copies.hpp"
#include "objects/object_store.hpp"

namespace graze {

/// Keeps the surfaces of the objects that ask for queries, for the reports. A surface that has moved is
/// copied once, into memory that no report shows any more. One that has not is shared. Stepping thread only.
class GeometryKeeper {
 public:
  GeometryKeeper(TaskPool& tasks, const ObjectStore& store) : tasks_(tasks), store_(store) {}

  /// The geometry of now, after positions were read. It is the last one if nothing has changed, and nothing
  /// if no object asks for it.
  [[nodiscard]] KeptHandle<KeptGeometry> keep();
  /// Bytes of all copies, those that reports show included. Meshes are not counted.
  [[nodiscard]] std::size_t byte_count() const { return byte_count_; }

 private:
  /// An object that asks, with its copies.
  struct Asking {
    const Object* object = nullptr;
    std::uint64_t serial = 0;
    std::uint64_t version = 0;  ///< of the object's surface, when it was copied last
    SpareCopies<KeptSurface> copies;
  };

  void list_asking();
  [[nodiscard]] static bool is_outdated(const Asking& asking);
  void fill_copies();
  void fill(KeptGeometry& geometry);
  void order_boxes();
  void count_bytes();

  TaskPool& tasks_;
  const ObjectStore& store_;
  std::vector<Asking> asking_;  ///< ascending by serial
  std::vector<Asking> was_asking_;
  std::uint64_t listed_at_ = 0;  ///< ObjectStore::arrivals_and_departures, when they were listed
  std::vector<Asking*> to_copy_;
  KeptPool<KeptGeometry> geometries_;
  std::vector<KeptObject> objects_;  ///< memory for the next list
  BoxOrder box_order_;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::uint32_t fills_of_order_ = 0;  ///< how often it was used since it was made
  std::size_t byte_count_ = 0;
};

}  // namespace graze
