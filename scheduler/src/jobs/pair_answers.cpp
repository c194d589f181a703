#include "jobs/pair_answers.hpp"

#include <algorithm>
#include <utility>

#include "core/base/bytes_of.hpp"
#include "core/search/pair_detector.hpp"

namespace graze {
namespace {

/// The report adopts the longest list of contacts if it has at least this many. A job that is expected to
/// find such a list writes it into the report's memory. Without this the step would need as much memory once
/// more.
constexpr std::size_t longest_copied = 65536;

/// Lists of at least this many contacts stay where they were found. Shorter lists are copied, so that they
/// are adjacent in memory.
constexpr std::size_t long_list = 4096;

/// All of an answer but its lists.
const PairFinding& finding_of(const PairAnswer& answer) {
  return answer;
}

}  // namespace

PairAnswers::PairAnswers(const SceneSettings& settings, const ContactLimit& limit, StepDeadline& deadline,
                         JobWorkers& workers)
    : settings_(settings),
      limit_(limit),
      deadline_(deadline),
      workers_(workers),
      contacts_(static_cast<unsigned>(workers.all().size())),
      region_distances_(static_cast<unsigned>(workers.all().size())) {}

void PairAnswers::begin(std::span<const PairJob> jobs, std::uint64_t rules_version, const LastContacts& last,
                        ReportBuilder& report) {
  jobs_ = jobs;
  rules_version_ = rules_version;
  last_ = &last;
  if (answers_.size() < jobs.size()) answers_.resize(jobs.size());
  contacts_.begin();
  region_distances_.begin();
  long_jobs_.clear();
  lent_ = nullptr;
  if (limit_.is_shared())
    nearest_.begin(limit_.of_step(), settings_.detail);
  else
    expect_long_lists(report);
}

/// Takes the lists of the last step for what this step's will be. With a time budget the report's memory is
/// not lent, since jobs make room in it.
void PairAnswers::expect_long_lists(ReportBuilder& report) {
  std::size_t longest = longest_copied;
  for (std::uint32_t index = 0; index < jobs_.size(); ++index) {
    const PairJob& job = jobs_[index];
    if (!job.is_tested() || job.last == nullptr || job.last->contact_count < long_list) continue;
    if (!job.is_large()) long_jobs_.push_back(index);
    if (settings_.time_budget || job.last->contact_count < longest) continue;
    longest = job.last->contact_count;
    lent_ = &report.contact_memory();
    lent_to_ = index;
  }
  long_answers_.resize(std::max(long_answers_.size(), long_jobs_.size()));
}

// ---- While jobs run

PairAnswer& PairAnswers::answer_for(std::uint32_t job, JobWorker& worker) {
  const auto found = std::lower_bound(long_jobs_.begin(), long_jobs_.end(), job);
  if (found == long_jobs_.end() || *found != job) return worker.answer;
  return long_answers_[static_cast<std::size_t>(found - long_jobs_.begin())];
}

void PairAnswers::lend_to(std::uint32_t job, PairAnswer& answer) const {
  if (lent_ != nullptr && job == lent_to_) answer.contacts.swap(*lent_);
}

void PairAnswers::complete(std::uint32_t job, const PairQuery& query, PairAnswer& answer, JobWorker& worker) {
  if (limit_.chooses_carrying()) choose_carrying(job, answer, worker);
  if (!deadline_.make_room(answer.contacts.size()))
    PairDetector::outer_bounds(jobs_[job].a->surface(), jobs_[job].b->surface(), query, answer);
  remember(jobs_[job], answer);
}

void PairAnswers::choose_carrying(std::uint32_t job, PairAnswer& answer, JobWorker& worker) const {
  if (answer.contacts.empty()) return;
  const CarryingRule rule = limit_.carrying_rule(jobs_[job].thresholds.threshold);
  const bool has_more = worker.carrying.choose(answer.contacts, last_->of(job), rule);
  answer.cut = has_more && limit_.cuts_carrying();
}

/// Remembers for which positions and rules the answer holds. What met on the way is of one step only.
void PairAnswers::remember(const PairJob& job, const PairAnswer& answer) const {
  const bool whole = answer.complete && job.task == PairJob::Task::detect;
  PairMemory& memory = job.memory_to_write();
  memory.version_a = whole && !job.is_swept ? job.a->surface().version() : 0;
  memory.version_b = whole ? job.b->surface().version() : 0;
  memory.rules_version = rules_version_;
}

void PairAnswers::keep(std::uint32_t job, PairAnswer& answer, unsigned worker) {
  JobWorker& own = workers_[worker];
  if (limit_.is_shared() || &answer != &own.answer) return keep_in_place(job, answer, worker);
  if (answer.contacts.size() < long_list) return copy(job, answer, worker);
  keep_in_place(job, own.too_long.emplace_back(std::exchange(answer, {})), worker);
}

void PairAnswers::copy(std::uint32_t job, const PairAnswer& answer, unsigned worker) {
  answers_[job] = {finding_of(answer), contacts_.keep(answer.contacts, worker),
                   region_distances_.keep(answer.region_distances, worker)};
}

/// Of pairs that share a limit nothing stays: the nearest contacts take copies, and their number is kept
/// until `share_contacts`.
void PairAnswers::keep_in_place(std::uint32_t job, const PairAnswer& answer, unsigned worker) {
  if (!limit_.is_shared()) {
    answers_[job] = {finding_of(answer), answer.contacts, answer.region_distances};
    return;
  }
  nearest_.add(job, answer.contacts);
  answers_[job] = {finding_of(answer), {}, region_distances_.keep(answer.region_distances, worker)};
  answers_[job].contacts_left_out = static_cast<std::uint32_t>(answer.contacts.size());
}

// ---- After the jobs

/// Selects the nearest contacts of all jobs. The contacts of jobs that did not test their pairs come from the
/// last report. A pair that loses contacts is tested again in the next step even if it rests, since other
/// pairs may then have fewer.
void PairAnswers::share_contacts() {
  if (!limit_.is_shared()) return;
  for (std::uint32_t job = 0; job < jobs_.size(); ++job)
    if (!jobs_[job].is_tested()) repeat_without_contacts(job);
  nearest_.finish([&](std::uint32_t job, std::span<const Contact> contacts) { set_contacts(job, contacts); });
  for (std::uint32_t job = 0; job < jobs_.size(); ++job)
    if (answers_[job].contacts_left_out > 0) jobs_[job].memory->version_a = 0;
}

void PairAnswers::repeat_without_contacts(std::uint32_t job) {
  const auto contacts = last_->of(job);
  answers_[job] = {};
  answers_[job].contacts_left_out = static_cast<std::uint32_t>(contacts.size());
  nearest_.add(job, contacts);
}

void PairAnswers::set_contacts(std::uint32_t job, std::span<const Contact> contacts) {
  answers_[job].contacts = contacts;
  answers_[job].contacts_left_out -= static_cast<std::uint32_t>(contacts.size());
}

std::span<const Contact> PairAnswers::contacts(std::size_t job) const {
  const bool repeats_last = !jobs_[job].is_tested() && !limit_.is_shared();
  return repeats_last ? last_->of(job) : answers_[job].contacts;
}

std::vector<Contact>* PairAnswers::longest_list(std::span<PairAnswer> others) {
  if (limit_.is_shared() || settings_.time_budget) return nullptr;
  std::vector<Contact>* longest = nullptr;
  const auto consider = [&](PairAnswer& answer) {
    if (answer.contacts.size() >= (longest == nullptr ? longest_copied : longest->size()))
      longest = &answer.contacts;
  };
  for (PairAnswer& answer : others) consider(answer);
  for (PairAnswer& answer : std::span(long_answers_).first(long_jobs_.size())) consider(answer);
  for (JobWorker& worker : workers_.all())
    for (PairAnswer& answer : worker.too_long) consider(answer);
  return longest;
}

// ---- Memory

void PairAnswers::grow_to_demand() {
  contacts_.grow_to_demand();
  region_distances_.grow_to_demand();
  for (JobWorker& worker : workers_.all()) {
    for (PairAnswer& answer : worker.too_long) long_answers_.push_back(std::move(answer));
    worker.too_long.clear();
  }
}

void PairAnswers::reserve(std::size_t answers, std::size_t contacts) {
  if (answers_.size() < answers) answers_.resize(answers);
  contacts_.reserve(contacts);
  region_distances_.reserve(settings_.region_distances);
  if (limit_.is_shared()) nearest_.reserve(limit_.of_step(), contacts);
}

std::size_t PairAnswers::byte_count() const {
  std::size_t bytes = bytes_of(answers_) + contacts_.byte_count() + region_distances_.byte_count() +
                      nearest_.byte_count() + bytes_of(long_jobs_) + bytes_of(long_answers_);
  for (const PairAnswer& answer : long_answers_) bytes += bytes_of_lists(answer);
  return bytes;
}

}  // namespace graze
