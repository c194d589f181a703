#include "search/deepest_contacts.hpp"

#include <algorithm>

#include "core/pair/contact_rank.hpp"

namespace graze {
namespace {

bool is_kept_before(const Contact& left, const Contact& right) {
  const double rank_left = contact_rank(ContactDetail::nearest, left);
  const double rank_right = contact_rank(ContactDetail::nearest, right);
  return rank_left != rank_right ? rank_left < rank_right : contact_order(left) < contact_order(right);
}

}  // namespace

void keep_deepest(PairAnswer& answer, std::size_t most) {
  auto& contacts = answer.contacts;
  if (contacts.size() <= most) return;
  answer.cut = true;
  const auto end = contacts.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(contacts.begin(), end, contacts.end(), is_kept_before);
  contacts.erase(end, contacts.end());
  std::sort(contacts.begin(), contacts.end(), [](const Contact& left, const Contact& right) {
    return contact_order(left) < contact_order(right);
  });
}

}  // namespace graze
