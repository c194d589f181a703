#pragma once

#include <cstddef>
#include <graze/report.hpp>
#include <span>
#include <vector>

#include "core/base/bytes_of.hpp"
#include "pairs/pair_job.hpp"

namespace graze {

/// The contacts that the last report has of each job's pair, by the features of the meshes now. Where a mesh
/// was replaced since, the features are mapped, and contacts of which one is gone are left out. Contacts that
/// become one have the earliest Contact::since of these. Stepping thread only, except for the const members.
class LastContacts {
 public:
  /// Begins a step. `some_replaced` says whether jobs have to be asked for replaced meshes.
  void begin(const FrameReport& last, std::span<const PairJob> jobs, bool some_replaced);
  /// The contacts of a job's pair, sorted by their features. They stay valid until the next `begin`.
  [[nodiscard]] std::span<const Contact> of(std::size_t job) const;
  /// The last report.
  [[nodiscard]] const FrameReport& report() const { return *last_; }
  [[nodiscard]] std::size_t byte_count() const { return bytes_of(mapped_) + bytes_of(contacts_); }

 private:
  /// The range in `contacts_` of a job with a replaced mesh.
  struct Mapped {
    std::size_t job;
    std::size_t begin;
    std::size_t count;
  };
  void map(std::size_t job);

  const FrameReport* last_ = nullptr;
  std::span<const PairJob> jobs_;
  std::vector<Mapped> mapped_;  ///< ascending by job
  std::vector<Contact> contacts_;
};

/// The witness of a pair's last row, by the features of the meshes now. For a feature that is gone it names
/// the vertex Mesh::no_vertex.
[[nodiscard]] Witness mapped_witness(const PairJob& job);

}  // namespace graze
