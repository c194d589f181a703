#include "patches/ignored_copies.hpp"

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

std::shared_ptr<const GroupFilter> copy_of(const GroupFilter& filter, const Object& tool,
                                           const Object& other) {
  const bool other_is_first = other.serial < tool.serial;
  auto copy = std::make_shared<GroupFilter>(other_is_first ? other.face_groups : tool.face_groups,
                                            other_is_first ? tool.face_groups : other.face_groups);
  filter.visit_ignored([&](std::uint8_t a, std::uint8_t b) { copy->set_ignored(a, b, true); });
  return copy;
}

}  // namespace

void IgnoredCopies::begin() {
  last_.swap(copies_);
  copies_.clear();
  next_ = 0;
}

std::shared_ptr<const GroupFilter> IgnoredCopies::of(const Object& tool, const Object& other,
                                                     const PairGroups& groups) {
  while (next_ < last_.size() && last_[next_].serial < other.serial) ++next_;
  const bool is_known =
      next_ < last_.size() && last_[next_].serial == other.serial && last_[next_].version == groups.version;
  copies_.push_back(
      {other.serial, groups.version, is_known ? last_[next_].filter : copy_of(*groups.filter, tool, other)});
  return copies_.back().filter;
}

std::size_t IgnoredCopies::byte_count() const {
  std::size_t bytes = bytes_of(copies_) + bytes_of(last_);
  for (const Copy& copy : copies_) bytes += copy.filter->byte_count();
  return bytes;
}

}  // namespace graze
