#include "jobs/pair_jobs.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "core/base/bytes_of.hpp"
#include "objects/leaf_test_slack.hpp"

namespace graze {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// The end of a budget that began at `start`, or no deadline if the clock cannot represent it.
std::chrono::steady_clock::time_point deadline_of(std::chrono::steady_clock::time_point start,
                                                  std::optional<std::chrono::microseconds> budget) {
  // This compares microseconds, since a clock in nanoseconds overflows for the largest budgets.
  const auto longest = std::chrono::floor<std::chrono::microseconds>(PairQuery::no_deadline - start);
  if (!budget || *budget >= longest) return PairQuery::no_deadline;
  return start + *budget;
}

// The time of a budget that is kept back for writing rows and contacts after the jobs. The numbers were
// measured and have a safety margin.
constexpr std::chrono::nanoseconds after_each_pair{150};
constexpr std::chrono::nanoseconds after_each_contact{60};
constexpr std::chrono::microseconds after_all{50};

/// A step keeps back 1 in this many parts of its time budget if the last step had no time left to equalize
/// capacity.
constexpr int part_for_room = 5;

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

/// The report adopts the longest list of contacts if it has at least this many. A job that is expected to
/// find such a list writes it into the report's memory. Without this the step would need as much memory once
/// more.
constexpr std::size_t longest_copied = 65536;

/// Lists of at least this many contacts stay where they were found. Shorter lists are copied, so that they
/// are adjacent in memory.
constexpr std::size_t long_list = 4096;

/// The largest number of leaf pairs in the fronts of all pairs of objects together. Each takes 16 bytes.
constexpr std::size_t front_pairs_of_all = std::size_t{1} << 22;

/// The number of contacts, of leaf pairs and of contacts at the least distance of one pair that each worker
/// reserves. SceneCapacity states it.
constexpr std::size_t reserved_of_pair = 1024;

/// How far two surfaces moved in this step, as an estimate of the next step's motion. A surface whose version
/// is the answered one did not move in this step, so its last displacement does not count. Neither does the
/// first placement of a surface.
double motion_of(const PairJob& job) {
  constexpr std::uint64_t placed_once = 1;
  const auto of = [](const Surface& surface, std::uint64_t answered) {
    const bool has_come = surface.version() > placed_once && surface.version() != answered;
    return has_come ? surface.displacement() : 0;
  };
  return of(job.a->surface(), job.memory->version_a) + of(job.b->surface(), job.memory->version_b);
}

double smaller_leaf_of(const PairJob& job) {
  return std::min(job.a->surface().leaf_size(), job.b->surface().leaf_size());
}

/// The slack of a front: it lasts for some steps of the last motion, but lists few leaf pairs that are not
/// near.
double slack_of(double motion, double leaf) {
  constexpr double steps = 6;
  constexpr double least_leaf_sizes = 1.0 / 64;
  constexpr double most_leaf_sizes = 0.5;
  if (motion > most_leaf_sizes * leaf) return 0;
  return std::clamp(steps * motion, least_leaf_sizes * leaf, most_leaf_sizes * leaf);
}

std::size_t bytes_of_lists(const PairAnswer& answer) {
  return bytes_of(answer.contacts) + bytes_of(answer.region_distances);
}

/// Returns what says which features of a pair are looked at, or null if all are, or none. It is in `room` if
/// faces are hidden, and no groups of the pair were ever ignored.
const FeatureFilter* filter_of(const PairJob& job, std::optional<FeatureFilter>& room) {
  room.reset();
  if (job.groups.version != 0) return job.groups.filter;
  if (!job.a->hides_some_faces() && !job.b->hides_some_faces()) return nullptr;
  room.emplace(job.a->face_groups.get(), job.b->face_groups.get());
  return room->leaves_some() ? &*room : nullptr;
}

}  // namespace

PairJobs::PairJobs(const SceneSettings& settings, TaskPool& tasks)
    : settings_(settings), tasks_(tasks), answers_(tasks.worker_count()), workers_(tasks.worker_count()) {}

PairQuery PairJobs::query_of(const PairJob& job, std::optional<FeatureFilter>& filter) const {
  PairQuery query;
  query.detail = settings_.detail;
  query.mode = settings_.accuracy.mode();
  query.tolerance = settings_.accuracy.tolerance();
  query.epsilon = job.thresholds.epsilon;
  query.threshold = job.thresholds.threshold;
  query.reach = job.thresholds.reach;
  query.groups = filter_of(job, filter);
  query.region_distance_reach = query.reach;
  query.region_distance_limit = settings_.region_distances == 0
                                    ? 0
                                    : std::max<std::size_t>(1, settings_.region_distances / pair_count_);
  if (job.was_in_contact()) query.reach = std::numeric_limits<double>::infinity();
  const double motion = motion_of(job);
  const double leaf = smaller_leaf_of(job);
  query.slack = slack_of(motion, leaf);
  query.leaf_test_slack = leaf_test_slack.of(motion, leaf);
  query.list_slack =
      (is_about_vertices(query.detail) ? list_slack_of_vertices : list_slack_of_features).of(motion, leaf);
  query.front_limit = front_pairs_of_all / pair_count_;
  query.contact_limit = contact_limit();
  // A list of features only helps if all of them may become contacts. It is made no longer than necessary.
  const bool may_be_cut =
      job.last == nullptr || job.last->contacts_cut || job.last->contact_count > query.contact_limit / 2;
  if (query.contact_limit > 0 && may_be_cut) query.list_slack = 0;
  if (!is_about_vertices(query.detail) && job.task == PairJob::Task::detect) {
    query.a_is_solid = job.a->settings.solid;
    query.b_is_solid = job.b->settings.solid;
    query.wants_way_out = settings_.ways_out && query.mode != AccuracyMode::paper;
  }
  if (job.task == PairJob::Task::end) {
    query.threshold = 0;
    if (!is_about_vertices(query.detail)) query.detail = ContactDetail::none;
  }
  return query;
}

/// The most contacts that the search for a pair keeps; 0 without a limit. Those that carry are chosen out of
/// all.
std::size_t PairJobs::contact_limit() const {
  if (chooses_carrying()) return 0;
  const std::size_t limit =
      std::min(settings_.max_contacts.value_or(no_limit), settings_.max_contacts_per_pair.value_or(no_limit));
  return limit == no_limit ? 0 : limit;
}

bool PairJobs::chooses_carrying() const {
  return settings_.carrying > 0 && settings_.detail == ContactDetail::nearest;
}

/// Leaves only those contacts in an answer that carry the pair. They are cut where a lower limit leaves out
/// what `carrying` would choose.
void PairJobs::choose_carrying(std::uint32_t index, PairAnswer& answer, Worker& worker) const {
  const std::size_t limit = settings_.max_contacts_per_pair.value_or(no_limit);
  const CarryingRule rule{std::min(settings_.carrying, limit),
                          settings_.carrying_band.value_or(jobs_[index].thresholds.threshold)};
  if (answer.contacts.empty()) return;
  const bool has_more = worker.carrying.choose(answer.contacts, last_->of(index), rule);
  answer.cut = has_more && limit < settings_.carrying;
}

void PairJobs::run(const PairList& list, std::uint64_t rules_version, Clock::time_point start,
                   const LastContacts& last, ReportBuilder& report) {
  jobs_ = list.jobs;
  last_ = &last;
  pair_count_ = list.pair_count;
  rules_version_ = rules_version;
  deadline_ = deadline_of(start, settings_.time_budget);
  answers_.begin(jobs_.size());
  large_answer_count_ = 0;
  for (Worker& worker : workers_) worker.counters = {};
  order_.clear();
  long_jobs_.clear();
  for (std::uint32_t index = 0; index < jobs_.size(); ++index) {
    const PairJob& job = jobs_[index];
    if (!job.is_tested()) continue;
    order_.push_back(index);
    if (!settings_.max_contacts && job.last != nullptr && job.last->contact_count >= long_list &&
        !is_large(job))
      long_jobs_.push_back(index);
  }
  long_answers_.resize(std::max(long_answers_.size(), long_jobs_.size()));
  keep_time_back(last.report().contacts().size(), report);
  lend_memory(report);
  nearest_.begin(settings_.max_contacts.value_or(0), settings_.detail);
  if (settings_.time_budget || settings_.work_budget) sort_by_urgency();
  if (settings_.work_budget)
    run_within_work(*settings_.work_budget);
  else
    settings_.time_budget ? run_by_urgency() : run_group(order_);
  if (settings_.max_contacts) share_contacts(last);
}

void PairJobs::lend_memory(ReportBuilder& report) {
  lent_ = nullptr;
  if (settings_.max_contacts || settings_.time_budget) return;
  std::size_t longest = longest_copied;
  for (const std::uint32_t index : order_) {
    const PairReport* const last = jobs_[index].last;
    if (last == nullptr || last->contact_count < longest) continue;
    longest = last->contact_count;
    lent_ = &report.contact_memory();
    lent_to_ = index;
  }
}

std::vector<Contact>* PairJobs::longest_list() {
  if (settings_.max_contacts || settings_.time_budget) return nullptr;
  std::vector<Contact>* longest = nullptr;
  const auto consider = [&](PairAnswer& answer) {
    if (answer.contacts.size() >= (longest == nullptr ? longest_copied : longest->size()))
      longest = &answer.contacts;
  };
  for (std::size_t i = 0; i < large_answer_count_; ++i) consider(large_answers_[i]);
  for (std::size_t i = 0; i < long_jobs_.size(); ++i) consider(long_answers_[i]);
  for (Worker& worker : workers_)
    for (PairAnswer& answer : worker.too_long) consider(answer);
  return longest;
}

/// Selects the nearest contacts of all jobs. The contacts of jobs that did not test their pairs come from the
/// last report. A pair that loses contacts is tested again in the next step even if it rests, since other
/// pairs may then have fewer.
void PairJobs::share_contacts(const LastContacts& last) {
  for (std::uint32_t index = 0; index < jobs_.size(); ++index) {
    if (jobs_[index].is_tested()) continue;
    const auto contacts = last.of(index);
    answers_.repeat_without_contacts(index, contacts.size());
    nearest_.add(index, contacts);
  }
  nearest_.finish([&](std::uint32_t index, std::span<const Contact> contacts) {
    answers_.set_contacts(index, contacts);
  });
  for (std::uint32_t index = 0; index < jobs_.size(); ++index)
    if (answers_[index].contacts_left_out > 0) jobs_[index].memory->version_a = 0;
}

bool PairJobs::is_large(const PairJob& job) {
  return std::min(job.a->surface().mesh().vertex_count(), job.b->surface().mesh().vertex_count()) >=
         LargePair::least_vertex_count;
}

/// Runs the small pairs in batches while the large ones begin, then runs the slices of the large ones.
///
/// A task writes the answers, fronts and memories of its own jobs, and the detector and counters of its own
/// worker. A slice writes its own part of its pair. Surfaces are only read. AccessScope checks this in builds
/// with GRAZE_VALIDATE.
void PairJobs::run_group(std::span<const std::uint32_t> jobs) {
  small_jobs_.clear();
  large_count_ = 0;
  for (const std::uint32_t index : jobs)
    if (is_large(jobs_[index]))
      add_large(index);
    else
      small_jobs_.push_back(index);
  // There are enough batches for any number of threads, and few enough that picking one costs nothing.
  const std::size_t each = std::clamp<std::size_t>(small_jobs_.size() / 256, 1, 16);
  const std::size_t batches = (small_jobs_.size() + each - 1) / each;
  large_answers_.resize(std::max(large_answers_.size(), large_answer_count_ + large_count_));
  tasks_.run(large_count_ + batches, [&](unsigned worker, std::size_t item) {
    if (item < large_count_) return begin_large(item, worker);
    const std::size_t begin = (item - large_count_) * each;
    const std::size_t end = std::min(begin + each, small_jobs_.size());
    for (std::size_t i = begin; i < end; ++i) detect(small_jobs_[i], worker, unlimited);
  });
  run_rounds_of_slices();
  large_answer_count_ += large_count_;
}

void PairJobs::add_large(std::uint32_t index) {
  if (large_.size() == large_count_) large_.emplace_back();
  large_[large_count_++].job = index;
}

/// The answer of a large job, which stays in place until the next step.
PairAnswer& PairJobs::answer_of_large(std::size_t index) {
  require_write(StepData::pairs, &jobs_[large_[index].job]);
  return large_answers_[large_answer_count_ + index];
}

void PairJobs::begin_large(std::size_t index, unsigned worker) {
  LargeJob& large = large_[index];
  const PairJob& job = jobs_[large.job];
  const AccessScope access({AccessRight::read(), AccessRight::write(&job)});
  const Surface& a = job.a->surface();
  const Surface& b = job.b->surface();
  PairQuery query = query_of(job, large.filter);
  query.deadline = deadline_now();
  query.time_after_contact = after_each_contact;
  PairAnswer& answer = answer_of_large(index);
  large.answered = is_late();
  if (large.answered) {
    PairDetector::outer_bounds(a, b, query, answer);
    return refer_to(large.job, answer, worker);
  }
  if (lent_ != nullptr && large.job == lent_to_) answer.contacts.swap(*lent_);
  LeafFront& front = job.memory_to_write().front;
  large.front_bytes = front.byte_count();
  large.pair.begin(a, b, query, front, answer);
  advance_large(index, worker);
}

void PairJobs::advance_large(std::size_t index, unsigned worker) {
  LargeJob& large = large_[index];
  const PairJob& job = jobs_[large.job];
  Worker& own = workers_[worker];
  large.answered = large.pair.advance(own.detector, own.counters);
  if (!large.answered) return;
  PairAnswer& answer = answer_of_large(index);
  if (chooses_carrying()) choose_carrying(large.job, answer, own);
  if (!make_room_in_report(answer.contacts.size()))
    PairDetector::outer_bounds(job.a->surface(), job.b->surface(), query_of(job, large.filter), answer);
  own.front_bytes += job.memory_to_write().front.byte_count() - large.front_bytes;
  remember_answer(job, answer);
  refer_to(large.job, answer, worker);
}

/// Runs the slices of all large pairs as one list, round after round, until every pair is answered.
void PairJobs::run_rounds_of_slices() {
  while (true) {
    slices_.clear();
    for (std::uint32_t index = 0; index < large_count_; ++index)
      if (!large_[index].answered)
        for (std::uint32_t slice = 0; slice < large_[index].pair.slice_count(); ++slice)
          slices_.push_back({index, slice});
    if (slices_.empty()) return;
    tasks_.run(slices_.size(), [&](unsigned worker, std::size_t item) {
      const auto [large, slice] = slices_[item];
      const AccessScope access({AccessRight::read(), {}});
      large_[large].pair.run_slice(slice, workers_[worker].detector, workers_[worker].counters);
    });
    tasks_.run(large_count_, [&](unsigned worker, std::size_t index) {
      const AccessScope access({AccessRight::read(), AccessRight::write(&jobs_[large_[index].job])});
      if (!large_[index].answered) advance_large(index, worker);
    });
  }
}

/// Moves the deadline forward by the time that writing rows and repeated contacts will take.
void PairJobs::keep_time_back(std::size_t last_contacts, ReportBuilder& report) {
  contacts_found_.store(0, std::memory_order_relaxed);
  if (deadline_ == PairQuery::no_deadline) return;
  for (const std::uint32_t index : order_)
    if (jobs_[index].last != nullptr) last_contacts -= jobs_[index].last->contact_count;
  deadline_ -= after_all + pair_count_ * after_each_pair + last_contacts * after_each_contact;
  if (owes_capacity_) deadline_ -= *settings_.time_budget / part_for_room;
  report_ = &report;
  contacts_with_room_ = last_contacts;
}

/// Makes room in the report for more contacts, and returns whether there is room. The first write to new
/// memory costs many times more than later writes. So the report touches it before the deadline, piece by
/// piece. If there is no time for it now, the next steps have time for it.
bool PairJobs::make_room_in_report(std::size_t contacts) {
  if (deadline_ == PairQuery::no_deadline || contacts == 0) return true;
  const std::lock_guard lock(report_mutex_);
  const std::size_t most = settings_.max_contacts.value_or(std::numeric_limits<std::size_t>::max());
  contacts = std::min(contacts, most - std::min(most, contacts_with_room_));
  if (!report_->make_room_while(contacts_with_room_ + contacts, [&] { return !is_late(); })) return false;
  contacts_with_room_ += contacts;
  contacts_found_.fetch_add(contacts, std::memory_order_relaxed);
  return true;
}

/// The deadline less the time in which all threads together will write the contacts found so far.
PairJobs::Clock::time_point PairJobs::deadline_now() const {
  if (deadline_ == PairQuery::no_deadline) return deadline_;
  return deadline_ - contacts_found_.load(std::memory_order_relaxed) * after_each_contact / workers_.size();
}

bool PairJobs::is_late() const {
  return deadline_ != PairQuery::no_deadline && Clock::now() >= deadline_now();
}

void PairJobs::detect(std::uint32_t index, unsigned worker, std::uint64_t work_limit) {
  const PairJob& job = jobs_[index];
  const AccessScope access({AccessRight::read(), AccessRight::write(&job)});
  std::optional<FeatureFilter> filter;
  PairQuery query = query_of(job, filter);
  query.work_limit = work_limit;
  query.deadline = deadline_now();
  query.time_after_contact = after_each_contact;
  const Surface& a = job.a->surface();
  const Surface& b = job.b->surface();
  Worker& own = workers_[worker];
  PairAnswer& answer = answer_for(index, own);
  if (lent_ != nullptr && index == lent_to_) answer.contacts.swap(*lent_);
  if (work_limit == 0 || is_late()) {
    PairDetector::outer_bounds(a, b, query, answer);
  } else {
    LeafFront& front = job.memory_to_write().front;
    own.front_bytes -= front.byte_count();
    own.detector.detect(a, b, query, front, answer, own.counters);
    own.front_bytes += front.byte_count();
    if (chooses_carrying()) choose_carrying(index, answer, own);
    if (!make_room_in_report(answer.contacts.size())) PairDetector::outer_bounds(a, b, query, answer);
    if (query.region_distance_limit > 0) own.detector.region_distances(a, b, query, answer);
    remember_answer(job, answer);
  }
  require_write(StepData::pairs, &job);
  store_answer(index, answer, worker);
}

/// The object that receives the answer of a small job.
PairAnswer& PairJobs::answer_for(std::uint32_t index, Worker& worker) {
  const auto found = std::lower_bound(long_jobs_.begin(), long_jobs_.end(), index);
  if (found == long_jobs_.end() || *found != index) return worker.answer;
  return long_answers_[static_cast<std::size_t>(found - long_jobs_.begin())];
}

/// Keeps an answer whose lists stay in place until the next step.
void PairJobs::refer_to(std::uint32_t index, const PairAnswer& answer, unsigned worker) {
  if (!settings_.max_contacts) return answers_.refer_to(index, answer);
  nearest_.add(index, answer.contacts);
  answers_.keep_without_contacts(index, answer, worker);
}

void PairJobs::store_answer(std::uint32_t index, PairAnswer& answer, unsigned worker) {
  if (settings_.max_contacts) return refer_to(index, answer, worker);
  Worker& own = workers_[worker];
  if (&answer != &own.answer) return answers_.refer_to(index, answer);
  if (answer.contacts.size() < long_list) return answers_.keep(index, answer, worker);
  answers_.refer_to(index, own.too_long.emplace_back(std::exchange(answer, {})));
}

/// Remembers for which positions and rules the answer holds.
void PairJobs::remember_answer(const PairJob& job, const PairAnswer& answer) const {
  const bool whole = answer.complete && job.task == PairJob::Task::detect;
  PairMemory& memory = job.memory_to_write();
  memory.version_a = whole ? job.a->surface().version() : 0;
  memory.version_b = whole ? job.b->surface().version() : 0;
  memory.rules_version = rules_version_;
}

/// Sorts jobs by urgency: pairs in contact first, then by the lower bound of their distance.
void PairJobs::sort_by_urgency() {
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t left, std::uint32_t right) {
    const auto urgency = [&](std::uint32_t index) {
      const PairJob& job = jobs_[index];
      return std::tuple(!job.was_in_contact(), lower_distance(job.a->box, job.b->box), index);
    };
    return urgency(left) < urgency(right);
  });
}

/// Runs jobs by urgency. A large pair gets all threads when its turn comes, so that no less urgent pair goes
/// first.
void PairJobs::run_by_urgency() {
  const std::span<const std::uint32_t> order(order_);
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    if (!is_large(jobs_[order[begin]]))
      while (end < order.size() && !is_large(jobs_[order[end]])) ++end;
    run_group(order.subspan(begin, end - begin));
    begin = end;
  }
}

/// Runs jobs one after the other. Each gets the work that the jobs before it left over, so the answer is the
/// same on any machine.
void PairJobs::run_within_work(std::uint64_t budget) {
  const PairCounters& counters = workers_[0].counters;
  for (const std::uint32_t index : order_) {
    const std::uint64_t before = counters.region_pairs_tested;
    detect(index, 0, budget);
    budget -= std::min(budget, counters.region_pairs_tested - before);
  }
}

PairCounters PairJobs::counters() const {
  PairCounters sum;
  for (const Worker& worker : workers_) sum.add(worker.counters);
  return sum;
}

// ---- Memory

/// The workers get jobs by chance, so all of them get the capacity that any of them needed.
bool PairJobs::equalize_capacity(Clock::time_point start) {
  answers_.grow_to_demand();
  for (Worker& worker : workers_) {
    for (PairAnswer& answer : worker.too_long) long_answers_.push_back(std::move(answer));
    worker.too_long.clear();
  }
  owes_capacity_ = true;  // stays true if this returns early
  const Clock::time_point end = deadline_of(start, settings_.time_budget);
  const auto is_over = [end] { return end != PairQuery::no_deadline && Clock::now() >= end; };
  Worker& first = workers_.front();
  for (const Worker& worker : std::span(workers_).subspan(1)) {
    if (is_over()) return false;
    first.reserve_as(worker);
  }
  for (Worker& worker : std::span(workers_).subspan(1)) {
    if (is_over()) return false;
    worker.reserve_as(first);
  }
  owes_capacity_ = is_over();  // the reports have no time left either
  return !owes_capacity_;
}

void PairJobs::reserve(std::size_t jobs, std::size_t contacts) {
  answers_.reserve(jobs, contacts, settings_.region_distances);
  order_.reserve(jobs);
  small_jobs_.reserve(jobs);
  room_.contacts = std::max(room_.contacts, std::min(contacts, reserved_of_pair));
  room_.leaf_pairs = room_.ties = reserved_of_pair;
  room_.region_distances = settings_.region_distances;
  if (settings_.max_contacts) nearest_.reserve(*settings_.max_contacts, contacts);
  reserve_workers();
}

void PairJobs::reserve_for(const IndexedMesh& mesh, bool is_solid) {
  room_.include(mesh);
  is_for_solids_ = is_for_solids_ || (is_solid && !is_about_vertices(settings_.detail));
  reserve_workers();
}

void PairJobs::reserve_workers() {
  const std::size_t limit = contact_limit();
  for (Worker& worker : workers_) {
    worker.reserve(room_);
    if (is_for_solids_) worker.detector.reserve_for_solids(room_);
    if (settings_.ways_out && !is_about_vertices(settings_.detail))
      worker.detector.reserve_for_ways_out(room_);
    if (limit > 0) worker.detector.reserve_for_limit(limit, room_);
    if (chooses_carrying()) worker.carrying.reserve(room_.contacts);
  }
}

std::size_t PairJobs::byte_count() const {
  std::size_t bytes = answers_.byte_count() + bytes_of(order_) + bytes_of(small_jobs_) + bytes_of(large_) +
                      bytes_of(large_answers_) + bytes_of(slices_) + bytes_of(long_jobs_) +
                      bytes_of(long_answers_) + nearest_.byte_count();
  for (const LargeJob& large : large_) bytes += large.pair.byte_count();
  for (const auto* const answers : {&large_answers_, &long_answers_})
    for (const PairAnswer& answer : *answers) bytes += bytes_of_lists(answer);
  for (const Worker& worker : workers_) bytes += worker.front_bytes;
  return bytes;
}

std::size_t PairJobs::thread_byte_count() const {
  std::size_t bytes = bytes_of(workers_);
  for (const Worker& worker : workers_)
    bytes += worker.detector.byte_count() + worker.carrying.byte_count() + bytes_of_lists(worker.answer);
  return bytes;
}

void PairJobs::Worker::reserve_as(const Worker& other) {
  detector.reserve_as(other.detector);
  carrying.reserve_as(other.carrying);
  answer.contacts.reserve(other.answer.contacts.capacity());
  answer.region_distances.reserve(other.answer.region_distances.capacity());
}

void PairJobs::Worker::reserve(const PairRoom& room) {
  detector.reserve(room);
  answer.contacts.reserve(room.contacts);
  answer.region_distances.reserve(room.region_distances);
}

}  // namespace graze
