#include "run_summary.hpp"

#include <algorithm>
#include <graze/io/printable.hpp>

#include "deepest_contact.hpp"
#include "distribution.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

std::string milliseconds(double value) {
  return rounded(value, 3) + " ms";
}

bool is_in_contact(const PairReport& pair) {
  return pair.phase == PairPhase::began || pair.phase == PairPhase::touching;
}

}  // namespace

RunSummary::RunSummary(std::span<const io::SceneObject> objects) : objects_(objects) {
  for (std::size_t number = 0; number < objects.size(); ++number) numbers_[objects[number].id] = number;
}

std::string RunSummary::name_of(std::size_t number) const {
  return io::printable(objects_[number].name);
}

std::string RunSummary::names_of(std::size_t a, std::size_t b) const {
  return name_of(a) + " and " + (a == b ? "itself" : name_of(b));
}

void RunSummary::add(std::uint32_t frame, const FrameReport& report, double step_ms) {
  step_ms_.push_back(step_ms);
  pairs_ = report.statistics().pairs_total;
  contacts_ += report.contacts().size();
  contacts_left_out_ += report.statistics().contacts_left_out;
  if (report.statistics().contacts_left_out > 0) ++frames_cut_;
  if (report.contacts().size() > most_contacts_) {
    most_contacts_ = report.contacts().size();
    busiest_frame_ = frame;
  }
  if (std::ranges::any_of(report.pairs(), is_in_contact)) ++frames_touching_;
  for (const PairReport& pair : report.pairs())
    if (is_in_contact(pair)) add_touch(frame, pair, report.contacts(pair));
  if (diagnostics_ == 0 && !report.diagnostics().empty()) {
    const Diagnostic& first = report.diagnostics().front();
    const std::string name = numbers_.contains(first.object) ? name_of(numbers_.at(first.object)) + ": " : "";
    first_diagnostic_ = "frame " + std::to_string(frame) + ", " + name + io::printable(first.message);
  }
  diagnostics_ += report.diagnostics().size();
}

void RunSummary::add_touch(std::uint32_t frame, const PairReport& pair, std::span<const Contact> contacts) {
  const auto [entry, is_new] = touches_.try_emplace({numbers_.at(pair.a), numbers_.at(pair.b)});
  Touch& touch = entry->second;
  if (is_new) {
    touch.first_frame = frame;
    touch.first_place = 0.5 * (pair.witness.point_a + pair.witness.point_b);
  }
  if (pair.phase == PairPhase::began) ++touch.spells;
  touch.last_frame = frame;
  ++touch.frames;
  ++touch.insides[static_cast<std::size_t>(pair.inside)];
  touch.most_contacts = std::max(touch.most_contacts, pair.contact_count);
  const Contact* const contact = deepest_contact(contacts);
  if (contact != nullptr && (!touch.deepest || contact->separation() < touch.deepest->separation))
    touch.deepest = {contact->separation(), frame};
}

std::string RunSummary::inside_text(std::size_t a, std::size_t b, const Touch& touch) const {
  const auto frames = [&touch](Inside inside) { return touch.insides[static_cast<std::size_t>(inside)]; };
  const auto clause = [&](Inside inside, const std::string& words) {
    return frames(inside) > 0 ? "; " + words + " in " + counted(frames(inside), "frame") : std::string();
  };
  const std::string name_a = name_of(a);
  const std::string name_b = name_of(b);
  return clause(Inside::crossing, "they cross") + clause(Inside::a_in_b, name_a + " is inside " + name_b) +
         clause(Inside::b_in_a, name_b + " is inside " + name_a);
}

std::string RunSummary::deepest_text(const Touch& touch) {
  if (!touch.deepest) return "";
  return "; deepest separation " + rounded(touch.deepest->separation, 4) + " in frame " +
         std::to_string(touch.deepest->frame);
}

std::string RunSummary::touches_text() const {
  if (touches_.empty()) return "touching  nothing\n";
  std::string text;
  for (const auto& [pair, touch] : touches_) {
    const Eigen::Vector3d& place = touch.first_place;
    const std::string where = format("(%.4g, %.4g, %.4g)", place.x(), place.y(), place.z());
    text += "touching  " + names_of(pair.first, pair.second) + ": first in frame " +
            std::to_string(touch.first_frame) + " at " + where + ", last in frame " +
            std::to_string(touch.last_frame) + "; " + counted(touch.frames, "frame") + " in " +
            counted(touch.spells, "spell") + ", at most " + counted(touch.most_contacts, "contact") +
            deepest_text(touch) + inside_text(pair.first, pair.second, touch) + "\n";
  }
  return text;
}

std::string RunSummary::diagnostics_text() const {
  if (diagnostics_ == 0) return "";
  return "input     " + counted(diagnostics_, "diagnostic") + ", the first: " + first_diagnostic_ + "\n";
}

std::string RunSummary::limits_text() const {
  if (frames_cut_ == 0) return "";
  return "limits    left out at least " + counted(contacts_left_out_, "contact") + ", in " +
         counted(frames_cut_, "frame") + "\n";
}

std::string RunSummary::times_text() const {
  if (step_ms_.empty()) return "";
  const Distribution times(step_ms_);
  return "step      median " + milliseconds(times.median()) + ", 99th percentile " +
         milliseconds(times.quantile(0.99)) + ", worst " + milliseconds(times.quantile(1)) + "\n";
}

std::string RunSummary::text() const {
  std::string contacts = "contacts  " + std::to_string(contacts_) + " in all, in contact in " +
                         std::to_string(frames_touching_) + " of " + counted(step_ms_.size(), "frame");
  if (most_contacts_ > 0)
    contacts +=
        "; at most " + std::to_string(most_contacts_) + ", in frame " + std::to_string(busiest_frame_);
  return "scene     " + counted(step_ms_.size(), "frame") + ", " + counted(objects_.size(), "object") + ", " +
         counted(pairs_, "pair") + "\n" + contacts + "\n" + limits_text() + touches_text() +
         diagnostics_text() + times_text();
}

}  // namespace graze::tools
