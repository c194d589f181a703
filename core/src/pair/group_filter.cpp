#include "core/pair/group_filter.hpp"

#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

std::shared_ptr<const FaceGroups> or_all_in_one(std::shared_ptr<const FaceGroups> groups) {
  return groups == nullptr ? std::make_shared<const FaceGroups>() : std::move(groups);
}

}  // namespace

GroupFilter::GroupFilter(std::shared_ptr<const FaceGroups> a, std::shared_ptr<const FaceGroups> b)
    : a_(or_all_in_one(std::move(a))),
      b_(or_all_in_one(std::move(b))),
      looked_at_(GroupSet().size(), ~GroupSet()),
      partners_(a_->sets().size()) {
  find_all();
}

void GroupFilter::set_groups_of_a(std::shared_ptr<const FaceGroups> groups) {
  groups = or_all_in_one(std::move(groups));
  partners_.resize(groups->sets().size());
  a_ = std::move(groups);
  find_all();
}

void GroupFilter::set_groups_of_b(std::shared_ptr<const FaceGroups> groups) {
  b_ = or_all_in_one(std::move(groups));
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
  for (std::size_t set = 0; set < partners_.size(); ++set) {
    partners_[set].reset();
    const GroupSet& groups = a_->sets()[set];
    for (std::size_t group = 0; group < groups.size(); ++group)
      if (groups.test(group)) partners_[set] |= looked_at_[group];
  }
}

void GroupFilter::find_some_faces() {
  leaves_some_ = false;
  leaves_all_ = true;
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
  return sizeof(GroupFilter) + bytes_of(looked_at_) + bytes_of(partners_);
}

}  // namespace graze
