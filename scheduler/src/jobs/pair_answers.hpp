#pragma once

#include <cstdint>
#include <graze/settings.hpp>
#include <span>
#include <vector>

#include "base/contact_limit.hpp"
#include "base/shared_buffer.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_query.hpp"
#include "jobs/job_workers.hpp"
#include "jobs/last_contacts.hpp"
#include "jobs/nearest_contacts.hpp"
#include "jobs/step_deadline.hpp"
#include "pairs/pair_job.hpp"
#include "report/report_builder.hpp"

namespace graze {

/// A PairAnswer whose lists are stored elsewhere.
struct KeptAnswer : PairFinding {
  std::span<const Contact> contacts;
  std::span<const RegionDistance> region_distances;
};

/// The answers of a step's jobs: which contacts they have, and where these are until the report is written.
///
/// Short lists are copied into one buffer, which grows with the number of contacts of all pairs together. A
/// long list stays where it was found: in an answer of the job's own, or in the report's memory, which is
/// lent to one job. If the pairs share a limit of contacts, the nearest of all are copied and nothing else.
///
/// The stepping thread uses it. While jobs run, any thread may call the functions that say so, for different
/// jobs: a call writes what belongs to its job or to its worker. Beyond that there are three things that all
/// jobs write. Of the shared buffers each list gets a part of its own by an atomic addition. The nearest
/// contacts and the room in the report have a mutex each.
class PairAnswers {
 public:
  PairAnswers(const SceneSettings& settings, const ContactLimit& limit, StepDeadline& deadline,
              JobWorkers& workers);

  /// Begins a step with these jobs and this version of the rules. The memory of the report's contacts may be
  /// lent to one job.
  void begin(std::span<const PairJob> jobs, std::uint64_t rules_version, const LastContacts& last,
             ReportBuilder& report);

  /// The object for the answer of a job whose pair is small. Any thread may call this.
  [[nodiscard]] PairAnswer& answer_for(std::uint32_t job, JobWorker& worker);
  /// Gives an answer the report's memory for its contacts if this job has it. Any thread may call this.
  void lend_to(std::uint32_t job, PairAnswer& answer) const;
  /// Completes the answer that a search has found: it lists the contacts that carry the pair if only these
  /// are wanted. If there is no time for its contacts it becomes one without. The pair remembers for what it
  /// holds. Any thread may call this.
  void complete(std::uint32_t job, const PairQuery& query, PairAnswer& answer, JobWorker& worker);
  /// Keeps an answer that was made in the object of `answer_for`. Any thread may call this.
  void keep(std::uint32_t job, PairAnswer& answer, unsigned worker);
  /// Keeps an answer whose lists stay where they are until the next step. Any thread may call this.
  void keep_in_place(std::uint32_t job, const PairAnswer& answer, unsigned worker);
  /// Ends the jobs: if the pairs share a limit, it selects which contacts each of them lists.
  void share_contacts();

  /// The answer of a job that tested its pair, valid until `grow_to_demand`.
  [[nodiscard]] const KeptAnswer& operator[](std::size_t job) const { return answers_[job]; }
  /// The contacts that a report lists of a job's pair, if that is in contact.
  [[nodiscard]] std::span<const Contact> contacts(std::size_t job) const;
  /// How many contacts of a job's pair others have taken the place of.
  [[nodiscard]] std::size_t contacts_left_out(std::size_t job) const {
    return limit_.is_shared() ? answers_[job].contacts_left_out : 0;
  }
  /// The longest list of contacts, if it is better adopted by the report than copied. It is one of these
  /// answers or of `others`, which were kept in place. Otherwise it is null.
  [[nodiscard]] std::vector<Contact>* longest_list(std::span<PairAnswer> others);

  /// Grows all memory so that a step with answers of this size allocates nothing. Discards all lists.
  void grow_to_demand();
  /// Reserves memory for that many answers, and for the contacts of all of them together.
  void reserve(std::size_t answers, std::size_t contacts);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void expect_long_lists(ReportBuilder& report);
  void choose_carrying(std::uint32_t job, PairAnswer& answer, JobWorker& worker) const;
  void remember(const PairJob& job, const PairAnswer& answer) const;
  void copy(std::uint32_t job, const PairAnswer& answer, unsigned worker);
  void repeat_without_contacts(std::uint32_t job);
  void set_contacts(std::uint32_t job, std::span<const Contact> contacts);

  const SceneSettings& settings_;
  const ContactLimit& limit_;
  StepDeadline& deadline_;
  JobWorkers& workers_;
  std::span<const PairJob> jobs_;
  std::uint64_t rules_version_ = 0;
  const LastContacts* last_ = nullptr;
  std::vector<KeptAnswer> answers_;
  SharedBuffer<Contact> contacts_;
  SharedBuffer<RegionDistance> region_distances_;
  NearestContacts nearest_;               ///< of all jobs, if they share a limit
  std::vector<std::uint32_t> long_jobs_;  ///< small jobs with long lists in the last step, ascending
  std::vector<PairAnswer> long_answers_;  ///< the answers of long_jobs_. It never shrinks
  std::vector<Contact>* lent_ = nullptr;  ///< the report's memory, lent to one job
  std::uint32_t lent_to_ = 0;             ///< the job that has it
};

}  // namespace graze
