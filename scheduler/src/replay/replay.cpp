#include <cstdio>
#include <graze/error.hpp>
#include <graze/recording.hpp>
#include <memory>
#include <set>
#include <utility>

#include "recording/recorded_rows.hpp"
#include "replay/recording_reader.hpp"
#include "replay/replayed_scene.hpp"
#include "replay/row_comparison.hpp"
#include "step/scene_state.hpp"

namespace graze {
namespace {

/// A number to its last digit.
std::string exact_text(double number) {
  std::array<char, 32> text{};
  (void)std::snprintf(text.data(), text.size(), "%.17g", number);
  return text.data();
}

std::string line_of(const RecordedRow* row) {
  if (row == nullptr) return "not listed";
  std::string line(to_string(row->phase));
  line += ", distance " + exact_text(row->lower) + " to " + exact_text(row->upper);
  line += ", " + std::to_string(row->contacts) + " contacts";
  if (!row->complete) line += ", not complete";
  if (row->stale) line += ", stale";
  std::array<char, 64> hashes{};
  (void)std::snprintf(hashes.data(), hashes.size(), ", answer %016llx, history %016llx",
                      static_cast<unsigned long long>(row->answer_hash),
                      static_cast<unsigned long long>(row->history_hash));
  return line + hashes.data();
}

bool are_of_one_pair(const RecordedRow& left, const RecordedRow& right) {
  return left.a == right.a && left.b == right.b;
}

/// The settings that a replay has.
SceneSettings replayed_settings(SceneSettings settings, const ReplaySettings& replay) {
  if (replay.threads) settings.threads = *replay.threads;
  settings.time_budget.reset();
  return settings;
}

}  // namespace

class Replay::State {
 public:
  State(const RecordingReader& reader, const ReplaySettings& settings);

  bool step();

  std::size_t index = 0;  ///< of the last step
  ReportHandle report;
  std::optional<ReplayDifference> difference;
  std::size_t rows_not_compared = 0;
  std::size_t rows_compared_in_part = 0;
  std::vector<ReplayObject> objects;
  std::shared_ptr<const PairFilters> filters;
  std::unique_ptr<ReplayedScene> played;

 private:
  void begin_scene(bool knows_history);
  void take_expected(StepHead& head);
  void compare();
  [[nodiscard]] bool is_recorded(const RecordedRow& row) const;
  void compare_rows();
  void compare_row(const RecordedRow* recorded, const RecordedRow* replayed);
  void compare_diagnostics();
  void tell(const RecordedRow* recorded, const RecordedRow* replayed);

  const RecordingReader& reader_;
  ReplaySettings settings_;
  std::size_t next_ = 0;  ///< the index of the next step
  RecordCheck check_;
  std::unique_ptr<Scene> scene_;
  /// The scene has gone through all that the recorded one did, so phases, ages, stale rows and diagnostics
  /// are as they were there.
  bool knows_history_ = false;
  RecordedReport expected_;
  std::set<std::pair<ObjectId, ObjectId>> recorded_pairs_;  ///< of `expected_`
  RecordedReport found_;
  ByteBuffer payload_;
};

Replay::State::State(const RecordingReader& reader, const ReplaySettings& settings)
    : reader_(reader), settings_(settings), check_(reader.new_check()) {
  const std::size_t count = reader.steps().size();
  if (count == 0) throw Error("the recording has no frame");
  if (settings.first_frame >= count)
    throw Error("the recording has " + std::to_string(count) + " frames, so there is no frame of index " +
                std::to_string(settings.first_frame));
  next_ = reader.step_to_begin_at(settings.first_frame);
  begin_scene(false);
  reader.visit_keyframe(next_, payload_, check_, [&](const Record& record) { played->apply(record); });
  while (next_ < settings.first_frame) (void)step();
}

void Replay::State::begin_scene(bool knows_history) {
  scene_.reset();  // before the memory that it is bound to
  played.reset();
  scene_ = std::make_unique<Scene>(replayed_settings(reader_.settings().settings, settings_));
  played = std::make_unique<ReplayedScene>(reader_, *scene_, scene_->state_->staging);
  knows_history_ = knows_history;
}

bool Replay::State::step() {
  if (next_ == reader_.steps().size()) return false;
  index = next_++;
  played->forget_removed();
  (void)reader_.visit_step(
      index, payload_, check_,
      [&](StepHead& head) {
        // A recording that begins with a scene's first step knows all that came before: nothing.
        if (head.is_fresh) begin_scene(head.report.frame == 1 && !reader_.settings().is_cut);
        take_expected(head);
      },
      [&](const Record& record) { played->apply(record); });
  reader_.check_passed(index, payload_);
  report = scene_->step(expected_.tag);
  objects = played->objects();
  filters = played->pair_filters();
  compare();
  return true;
}

void Replay::State::take_expected(StepHead& head) {
  if (head.has_rows_of_last) std::swap(head.report.rows, expected_.rows);
  expected_ = std::move(head.report);
  if (hash_of(expected_) != head.hash) throw Error("the hash of the report is not that of its rows");
}

void Replay::State::compare() {
  difference.reset();
  rows_not_compared = rows_compared_in_part = 0;
  summarize(*report, found_);
  for (RecordedRow& row : found_.rows) {
    row.a = played->recorded_id(row.a);
    row.b = played->recorded_id(row.b);
  }
  recorded_pairs_.clear();
  for (const RecordedRow& row : expected_.rows) recorded_pairs_.insert({row.a, row.b});
  compare_rows();
  if (!difference) compare_diagnostics();
}

bool Replay::State::is_recorded(const RecordedRow& row) const {
  return recorded_pairs_.contains({row.a, row.b});
}

/// Both reports list pairs in the same order, so the first row that differs is found by going through both.
void Replay::State::compare_rows() {
  std::size_t at = 0;
  const auto compare_others = [&] {
    while (at < found_.rows.size() && !is_recorded(found_.rows[at])) compare_row(nullptr, &found_.rows[at++]);
  };
  for (const RecordedRow& recorded : expected_.rows) {
    compare_others();
    const bool is_there = at < found_.rows.size() && are_of_one_pair(found_.rows[at], recorded);
    compare_row(&recorded, is_there ? &found_.rows[at++] : nullptr);
  }
  compare_others();
  if (at < found_.rows.size()) tell(nullptr, &found_.rows[at]);  // a recorded pair, in another order
}

void Replay::State::compare_row(const RecordedRow* recorded, const RecordedRow* replayed) {
  const RowComparison comparison(reader_.settings().settings, knows_history_);
  switch (comparison.compare(recorded, replayed, played->least_range())) {
    case RowVerdict::same:
      return;
    case RowVerdict::holds:
      ++rows_compared_in_part;
      return;
    case RowVerdict::not_compared:
      ++rows_not_compared;
      return;
    case RowVerdict::differs:
      tell(recorded, replayed);
  }
}

void Replay::State::compare_diagnostics() {
  const bool are_same =
      expected_.diagnostics == found_.diagnostics && expected_.diagnostics_hash == found_.diagnostics_hash;
  if (are_same || !knows_history_) return;
  difference = ReplayDifference{expected_.frame,
                                {},
                                std::to_string(expected_.diagnostics) + " diagnostics",
                                std::to_string(found_.diagnostics) + " diagnostics"};
}

/// Tells of the first difference of a step.
void Replay::State::tell(const RecordedRow* recorded, const RecordedRow* replayed) {
  if (difference) return;
  const RecordedRow& row = recorded != nullptr ? *recorded : *replayed;
  difference = ReplayDifference{expected_.frame, played->name_of(row.a) + " and " + played->name_of(row.b),
                                line_of(recorded), line_of(replayed)};
}

Replay::Replay(const Recording& recording, const ReplaySettings& settings)
    : state_(std::make_unique<State>(*recording.reader_, settings)) {}
Replay::~Replay() = default;

bool Replay::step() {
  return state_->step();
}
std::size_t Replay::frame_index() const {
  return state_->index;
}
const ReportHandle& Replay::report() const {
  return state_->report;
}
const std::optional<ReplayDifference>& Replay::difference() const {
  return state_->difference;
}
std::size_t Replay::rows_not_compared() const {
  return state_->rows_not_compared;
}
std::size_t Replay::rows_compared_in_part() const {
  return state_->rows_compared_in_part;
}
std::span<const ReplayObject> Replay::objects() const {
  return state_->objects;
}
const std::shared_ptr<const PairFilters>& Replay::pair_filters() const {
  return state_->filters;
}
void Replay::read_positions(std::size_t index, std::vector<Eigen::Vector3d>& positions) const {
  state_->played->read_positions(state_->objects[index].id, positions);
}
std::array<double, 12> Replay::pose(std::size_t index) const {
  return state_->played->pose(state_->objects[index].id);
}

}  // namespace graze
