#include "objects/object_summary.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <utility>

namespace graze {
namespace {

/// The number of objects that one task refreshes, and about how long one takes.
constexpr std::size_t objects_at_once = 256;
constexpr double nanoseconds_each_summary = 20;

ObjectSummary summary_of(const Object& object) {
  ObjectSummary summary;
  static_cast<FilterTraits&>(summary) = filter_traits_of(object);
  summary.box = object.box;
  summary.margin = object.settings.margin;
  summary.serial = object.serial;
  summary.kind = static_cast<std::uint16_t>(object.settings.kind);
  summary.hidden = object.hides_all_faces();
  return summary;
}

double shift_of(const Box& before, const Box& now) {
  return std::max((now.min - before.min).lpNorm<Eigen::Infinity>(),
                  (now.max - before.max).lpNorm<Eigen::Infinity>());
}

}  // namespace

/// Walks the objects before and now side by side, since serials ascend in both. Without insertions, an equal
/// count and an equal last serial mean that they are the same. A serial may come again with another arrival.
void ObjectSummaries::update_slots(std::span<const std::unique_ptr<Object>> objects,
                                   std::uint64_t insertions) {
  new_slots_.clear();
  const std::size_t before = summaries_.size();
  const bool some_inserted = std::exchange(insertions_, insertions) != insertions;
  if (!some_inserted && objects.size() == before &&
      (before == 0 || objects.back()->serial == summaries_.back().serial))
    return;
  new_slots_.resize(before);
  bool some_move = false;
  std::uint32_t now = 0;
  for (std::uint32_t slot = 0; slot < before; ++slot) {
    const std::uint64_t serial = summaries_[slot].serial;
    while (now < objects.size() && objects[now]->serial < serial) ++now;
    const bool stays =
        now < objects.size() && objects[now]->serial == serial && objects[now]->arrival == arrivals_[slot];
    new_slots_[slot] = stays ? now++ : no_slot;
    some_move = some_move || new_slots_[slot] != slot;
  }
  if (!some_move) new_slots_.clear();
  renumber(summaries_, new_slots_, objects.size());
  renumber(arrivals_, new_slots_, objects.size());
  visit_new_slots(new_slots_, before, objects.size(), [&](std::uint32_t slot) {
    summaries_[slot] = summary_of(*objects[slot]);
    arrivals_[slot] = objects[slot]->arrival;
  });
}

void ObjectSummaries::refresh(std::span<const std::unique_ptr<Object>> objects, TaskPool& tasks,
                              std::uint64_t insertions) {
  update_slots(objects, insertions);
  changed_.resize(objects.size());
  std::atomic<bool> some_unread = false;
  const auto refresh_slice = [&](unsigned, std::size_t index) {
    bool unread = false;
    const std::size_t end = std::min((index + 1) * objects_at_once, objects.size());
    for (std::size_t slot = index * objects_at_once; slot < end; ++slot) {
      const Object& object = *objects[slot];
      ObjectSummary& summary = summaries_[slot];
      const bool is_unread = object.is_unread();
      summary.motion = shift_of(summary.box, object.box);
      summary.moved = summary.read_late || !(summary.motion == 0);
      summary.read_late = false;
      const bool changed = !(summary.motion == 0) || summary.version != object.version ||
                           summary.frozen != object.frozen || summary.unread != is_unread ||
                           (is_unread && object.state != ReadState::still_surveyed);
      changed_[slot] = changed ? 1 : 0;
      summary.box = object.box;
      summary.version = object.version;
      summary.frozen = object.frozen;
      summary.unread = is_unread;
      summary.hidden = object.hides_all_faces();
      unread = unread || is_unread;
    }
    if (unread && !some_unread.load(std::memory_order_relaxed))
      some_unread.store(true, std::memory_order_relaxed);
  };
  tasks.run((objects.size() + objects_at_once - 1) / objects_at_once, std::ref(refresh_slice),
            {.nanoseconds = nanoseconds_each_summary * static_cast<double>(objects.size())});
  some_unread_ = some_unread;
}

void ObjectSummaries::refresh(std::span<Object* const> read_late) {
  for (const Object* const object : read_late) {
    ObjectSummary& summary = summaries_[slot_of(*object)];
    summary.read_late = !(shift_of(summary.box, object->box) == 0);
    summary.box = object->box;
    summary.version = object->version;
    summary.frozen = object->frozen;
    summary.unread = object->is_unread();
  }
}

void ObjectSummaries::take_up_sweeps(std::span<const std::unique_ptr<Object>> objects,
                                     const SweptObjects& swept) {
  sweeps_.resize(objects.size());
  for (std::size_t slot = 0; slot < objects.size(); ++slot) {
    const Object& object = *objects[slot];
    SweptSummary& summary = sweeps_[slot];
    summary.swept = object.settings.swept;
    summary.moves = swept.moves(object);
    summary.box = {summary.moves ? object.sweep->motion.start_box() : object.box, object.box};
  }
}

bool ObjectSummaries::may_meet_on_way(SlotPair pair, double gap) const {
  if (sweeps_.empty()) return false;
  const SweptSummary& a = sweeps_[first_of(pair)];
  const SweptSummary& b = sweeps_[second_of(pair)];
  if (!(a.swept || b.swept) || !(a.moves || b.moves)) return false;
  return first_meeting(gap > 0 ? grown(a.box, gap) : a.box, b.box) <= 1;
}

std::uint32_t ObjectSummaries::slot_of(const Object& object) const {
  return find_slot(object.serial);
}

std::uint32_t ObjectSummaries::find_slot(std::uint64_t serial) const {
  const auto found = std::lower_bound(
      summaries_.begin(), summaries_.end(), serial,
      [](const ObjectSummary& summary, std::uint64_t value) { return summary.serial < value; });
  if (found == summaries_.end() || found->serial != serial) return no_slot;
  return static_cast<std::uint32_t>(found - summaries_.begin());
}

}  // namespace graze
