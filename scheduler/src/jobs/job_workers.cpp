#include "jobs/job_workers.hpp"

#include <algorithm>

#include "core/pair/pair_query.hpp"

namespace graze {
namespace {

/// The number of contacts, of leaf pairs and of contacts at the least distance of one pair that each worker
/// reserves. SceneCapacity states it.
constexpr std::size_t reserved_of_pair = 1024;

}  // namespace

void JobWorker::count_bytes() {
  bytes = detector.byte_count() + carrying.byte_count() + bytes_of_lists(answer);
}

void JobWorker::reserve_as(const JobWorker& other) {
  detector.reserve_as(other.detector);
  carrying.reserve_as(other.carrying);
  answer.contacts.reserve(other.answer.contacts.capacity());
  answer.region_distances.reserve(other.answer.region_distances.capacity());
}

void JobWorker::reserve(const PairRoom& room) {
  detector.reserve(room);
  answer.contacts.reserve(room.contacts);
  answer.region_distances.reserve(room.region_distances);
}

void JobWorkers::begin() {
  for (JobWorker& worker : workers_) worker.counters = {};
}

PairCounters JobWorkers::counters() const {
  PairCounters sum;
  for (const JobWorker& worker : workers_) sum.add(worker.counters);
  return sum;
}

/// The workers get jobs by chance, so all of them get the capacity that any of them needed.
bool JobWorkers::equalize_capacity(const StepDeadline& deadline) {
  if (workers_.size() == 1) {
    workers_[0].count_bytes();
    return true;
  }
  // Lists never shrink. So where no number of bytes has changed, all capacities are still equal.
  const auto has_grown = [](const JobWorker& worker) { return worker.bytes != worker.equal_bytes; };
  if (std::none_of(workers_.begin(), workers_.end(), has_grown)) return true;
  JobWorker& first = workers_.front();
  for (const JobWorker& worker : std::span(workers_).subspan(1)) {
    if (deadline.is_over()) return false;
    first.reserve_as(worker);
  }
  for (JobWorker& worker : std::span(workers_).subspan(1)) {
    if (deadline.is_over()) return false;
    worker.reserve_as(first);
  }
  note_equal();
  return true;
}

void JobWorkers::note_equal() {
  for (JobWorker& worker : workers_) {
    worker.count_bytes();
    worker.equal_bytes = worker.bytes;
  }
}

void JobWorkers::reserve(std::size_t contacts) {
  room_.contacts = std::max(room_.contacts, std::min(contacts, reserved_of_pair));
  room_.leaf_pairs = room_.ties = reserved_of_pair;
  room_.region_distances = settings_.region_distances;
  make_room();
}

void JobWorkers::reserve_for(const IndexedMesh& mesh, bool is_solid) {
  room_.include(mesh);
  is_for_solids_ = is_for_solids_ || (is_solid && !is_about_vertices(settings_.detail));
  make_room();
}

void JobWorkers::make_room() {
  const std::size_t limit = contacts_.of_search();
  for (JobWorker& worker : workers_) {
    worker.reserve(room_);
    if (is_for_solids_) worker.detector.reserve_for_solids(room_);
    if (settings_.ways_out && !is_about_vertices(settings_.detail))
      worker.detector.reserve_for_ways_out(room_);
    if (limit > 0) worker.detector.reserve_for_limit(limit, room_);
    if (contacts_.chooses_carrying()) worker.carrying.reserve(room_.contacts);
    worker.count_bytes();
  }
}

std::size_t JobWorkers::front_bytes() const {
  std::size_t bytes = 0;
  for (const JobWorker& worker : workers_) bytes += worker.front_bytes;
  return bytes;
}

std::size_t JobWorkers::byte_count() const {
  std::size_t bytes = bytes_of(workers_);
  for (const JobWorker& worker : workers_) bytes += worker.bytes;
  return bytes;
}

}  // namespace graze
