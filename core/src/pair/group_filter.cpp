#include "core/pair/group_filter.hpp"

#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

const FaceGroups& or_all_in_one(const FaceGroups* groups) {
  static const FaceGroups all_in_one;
  return groups == nullptr ? all_in_one : *groups;
}

}  // namespace

FeatureFilter::FeatureFilter(const FaceGroups* a, const FaceGroups* b)
    : a_(&or_all_in_one(a)),
      b_(&or_all_in_one(b)),
      partners_(a_->partners().data()),
      some_faces_{a_->first_seen_face(), b_->first_seen_face()},
      leaves_some_(a_->all().any() && b_->all().any()),
      leaves_all_(!a_->hides_some() && !b_->hides_some()) {}

GroupFilter::GroupFilter(std::shared_ptr<const FaceGroups> a, std::shared_ptr<const FaceGroups> b)
    : FeatureFilter(a.get(), b.get()),
      kept_a_(std::move(a)),
      kept_b_(std::move(b)),
      looked_at_(GroupSet().size(), ~GroupSet()),
      partners_of_sets_(a_->sets().size()) {
  find_all();
}

void GroupFilter::set_groups_of_a(std::shared_ptr<const FaceGroups> groups) {
  const FaceGroups& now = or_all_in_one(groups.get());
  partners_of_sets_.resize(now.sets().size());
  a_ = &now;
  kept_a_ = std::move(groups);
  find_all();
}

void GroupFilter::set_groups_of_b(std::shared_ptr<const FaceGroups> groups) {
  b_ = &or_all_in_one(groups.get());
  kept_b_ = std::move(groups);
  find_all();
}

void GroupFilter::set_ignored(std::uint8_t group_a, std::uint8_t group_b, bool ignored) {
  looked_at_[group_a].set(group_b, !ignored);
  find_all();
}

void GroupFilter::find_all() {
  find_partners();
  find_some_faces();
}

void GroupFilter::find_partners() {
  for (std::size_t set = 0; set < partners_of_sets_.size(); ++set) {
    partners_of_sets_[set].reset();
    const GroupSet& groups = a_->sets()[set];
    for (std::size_t group = 0; group < groups.size(); ++group)
      if (groups.test(group)) partners_of_sets_[set] |= looked_at_[group];
  }
  partners_ = partners_of_sets_.data();
}

void GroupFilter::find_some_faces() {
  leaves_some_ = false;
  leaves_all_ = !a_->hides_some() && !b_->hides_some();
  for (std::size_t group = 0; group < a_->all().size(); ++group) {
    if (!a_->all().test(group)) continue;
    const GroupSet met = looked_at_[group] & b_->all();
    leaves_all_ = leaves_all_ && met == b_->all();
    if (met.none() || leaves_some_) continue;
    leaves_some_ = true;
    std::size_t of_b = 0;
    while (!met.test(of_b)) ++of_b;
    some_faces_ = {a_->first_face_of(group), b_->first_face_of(of_b)};
  }
}

std::size_t GroupFilter::byte_count() const {
  return sizeof(GroupFilter) + bytes_of(looked_at_) + bytes_of(partners_of_sets_);
}

}  // namespace graze
