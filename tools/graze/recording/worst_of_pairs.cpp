#include "recording/worst_of_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "deepest_contact.hpp"

namespace graze::tools {
namespace {

double change(const SeparationJump& jump) {
  return std::abs(jump.after - jump.before);
}

/// By their ids. An object that was removed before the step may still have a row.
std::map<ObjectId, const io::SnapshotObject*> objects_of(const io::SceneSnapshot& snapshot) {
  std::map<ObjectId, const io::SnapshotObject*> objects;
  for (const auto* list : {&snapshot.removed, &snapshot.objects})
    for (const io::SnapshotObject& object : *list) objects[object.id] = &object;
  return objects;
}

std::string name_of(const io::SnapshotObject& object) {
  return object.name.empty() ? "object " + std::to_string(object.serial) : "\"" + object.name + "\"";
}

std::string names_of(const io::SnapshotObject& a, const io::SnapshotObject& b) {
  return a.serial == b.serial ? name_of(a) + " and itself" : name_of(a) + " and " + name_of(b);
}

template <typename Value, typename Before>
std::vector<Value> sorted(const auto& values, const Before& before) {
  std::vector<Value> all;
  all.reserve(values.size());
  for (const auto& [pair, value] : values) all.push_back(value);
  std::ranges::stable_sort(all, before);
  return all;
}

}  // namespace

void WorstOfPairs::add(const io::SceneSnapshot& snapshot) {
  const auto objects = objects_of(snapshot);
  std::map<Pair, Separation> now;
  for (const PairReport& row : snapshot.report->pairs()) {
    const auto a = objects.find(row.a);
    const auto b = objects.find(row.b);
    if (a == objects.end() || b == objects.end()) continue;
    const Pair pair(a->second->serial, b->second->serial);
    const std::string names = names_of(*a->second, *b->second);
    const Contact* const contact = deepest_contact(snapshot.report->contacts(row));
    const Separation separation{contact != nullptr ? contact->separation() : row.distance.upper,
                                contact != nullptr};
    if (contact != nullptr) add_contact(pair, {names, snapshot.frame, separation.value, contact->point_a});
    const auto last = last_.find(pair);
    if (last != last_.end() && (separation.has_contact || last->second.has_contact))
      add_jump(pair, {names, snapshot.frame, last->second.value, separation.value});
    now.emplace(pair, separation);
  }
  last_ = std::move(now);
}

void WorstOfPairs::add_contact(const Pair& pair, const DeepestPlace& place) {
  const auto [known, is_new] = deepest_.try_emplace(pair, place);
  if (!is_new && place.separation < known->second.separation) known->second = place;
}

void WorstOfPairs::add_jump(const Pair& pair, const SeparationJump& jump) {
  if (!std::isfinite(change(jump)) || change(jump) == 0) return;
  const auto [known, is_new] = jumps_.try_emplace(pair, jump);
  if (!is_new && change(jump) > change(known->second)) known->second = jump;
}

std::vector<DeepestPlace> WorstOfPairs::deepest() const {
  return sorted<DeepestPlace>(deepest_, [](const DeepestPlace& left, const DeepestPlace& right) {
    return left.separation < right.separation;
  });
}

std::vector<SeparationJump> WorstOfPairs::jumps() const {
  return sorted<SeparationJump>(jumps_, [](const SeparationJump& left, const SeparationJump& right) {
    return change(left) > change(right);
  });
}

}  // namespace graze::tools
