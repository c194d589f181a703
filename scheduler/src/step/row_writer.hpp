#pragma once

#include <cstddef>
#include <graze/report.hpp>
#include <optional>

#include "base/task_pool.hpp"
#include "jobs/last_contacts.hpp"
#include "jobs/pair_jobs.hpp"
#include "jobs/pair_sweeps.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_table.hpp"
#include "report/contact_rows.hpp"
#include "report/report_builder.hpp"

namespace graze {

/// Writes the pairs of a report: their rows, contacts and distances of regions. Jobs ran in any order, but
/// their answers are written in the order of the pairs. Stepping thread only.
class RowWriter {
 public:
  RowWriter(TaskPool& tasks, const ObjectStore& store, PairTable& pairs, PairJobs& jobs,
            const PairSweeps& sweeps, const LastContacts& last_contacts)
      : tasks_(tasks),
        store_(store),
        pairs_(pairs),
        jobs_(jobs),
        sweeps_(sweeps),
        last_contacts_(last_contacts) {}

  /// Writes all pairs of a step whose jobs are answered, and counts them in the report's statistics. Returns
  /// whether no pair was tested and all rows are those of `previous`, unchanged.
  [[nodiscard]] bool write(const PairList& list, const FrameReport& previous, ReportBuilder& builder);

  /// Reserves memory for that many pairs.
  void reserve(std::size_t pairs) { contacts_.reserve(pairs); }
  [[nodiscard]] std::size_t byte_count() const { return contacts_.byte_count(); }

 private:
  void write_pair(const PairJob& job, std::size_t index, const FrameReport& previous, ReportBuilder& builder);
  [[nodiscard]] std::optional<PairReport> row_again(const PairJob& job);
  [[nodiscard]] bool is_of_old_mesh(const PairJob& job) const {
    return store_.some_replaced() && job.speaks_of_replaced();
  }
  void add_sweep(std::size_t index, PairReport& row, ReportBuilder& builder);
  void end_pair(PairReport row, ReportBuilder& builder);
  void repeat_pairs(const LastRows& resting, const FrameReport& previous, ReportBuilder& builder);

  TaskPool& tasks_;
  const ObjectStore& store_;
  PairTable& pairs_;
  PairJobs& jobs_;
  const PairSweeps& sweeps_;
  const LastContacts& last_contacts_;
  ContactRows contacts_;
  std::size_t rows_again_ = 0;  ///< rows of the current report that are unchanged from the last
};

}  // namespace graze
