#include "report/contact_rows.hpp"

#include <algorithm>
#include <functional>

#include "base/access.hpp"
#include "report/contact_key.hpp"

namespace graze {
namespace {

/// The number of contacts that one of several threads writes at a time, which takes some tens of
/// microseconds. One thread writes all contacts at once. In pieces that takes a third longer for pairs of
/// 10,000 contacts.
constexpr std::size_t contacts_each = 1024;

/// About how long a contact takes on one thread.
constexpr double nanoseconds_each_row = 20;

bool comes_before(const Contact& contact, const ContactKey& key) {
  return key_of(contact) < key;
}

/// Writes some contacts of a pair. A contact with the same features as one of the last report continues that
/// contact.
void write_contacts(std::span<const Contact> found, std::span<const Contact> last, std::span<Contact> rows,
                    std::uint64_t frame) {
  constexpr ContactKey behind_all{~std::uint64_t{0}, 0};
  auto before = last.begin();
  const auto key_before = [&] { return before == last.end() ? behind_all : key_of(*before); };
  ContactKey key_there = key_before();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const ContactKey key = key_of(found[i]);
    for (; key_there < key; key_there = key_before()) ++before;
    rows[i] = found[i];
    rows[i].since = key_there == key ? before->since : frame;
  }
}

/// The contacts of a pair from a given one on. This is only called for a part of a pair. For a whole pair the
/// search would read memory at random before it is read in order.
std::span<const Contact> from(std::span<const Contact> contacts, const Contact& first) {
  const auto begin = std::lower_bound(contacts.begin(), contacts.end(), key_of(first), comes_before);
  return contacts.subspan(static_cast<std::size_t>(begin - contacts.begin()));
}

}  // namespace

void ContactRows::adopt_list(std::vector<Contact>& list, ReportBuilder& report) {
  const auto pair = std::find_if(pairs_.begin(), pairs_.end(),
                                 [&](const Pair& each) { return each.contacts.data() == list.data(); });
  if (pair == pairs_.end() || 2 * pair->contacts.size() < count_) return;
  report.adopt_contacts(list, pair->first);
  pair->contacts = report.contacts().subspan(pair->first, pair->contacts.size());
}

/// Each task writes its own range of rows, whichever pairs they belong to.
void ContactRows::write(TaskPool& tasks, std::span<Contact> rows, std::uint64_t frame) const {
  const std::size_t each = tasks.worker_count() > 1 ? contacts_each : std::max<std::size_t>(count_, 1);
  const auto write_stretch = [&](unsigned /*worker*/, std::size_t item) {
    const AccessScope access({{}, AccessRight::read()});
    write_range(rows, item * each, std::min((item + 1) * each, count_), frame);
  };
  // The lambda is passed by reference, since std::function would allocate for what it captures.
  tasks.run((count_ + each - 1) / each, std::cref(write_stretch),
            {.nanoseconds = nanoseconds_each_row * static_cast<double>(count_)});
}

void ContactRows::write_range(std::span<Contact> rows, std::size_t begin, std::size_t end,
                              std::uint64_t frame) const {
  auto pair = std::upper_bound(pairs_.begin(), pairs_.end(), begin,
                               [](std::size_t row, const Pair& each) { return row < each.first; }) -
              1;
  for (; begin < end; ++pair) {
    const std::size_t first = begin - pair->first;
    const std::size_t count = std::min(end - begin, pair->contacts.size() - first);
    const auto found = pair->contacts.subspan(first, count);
    const auto written = rows.subspan(begin, count);
    if (pair->is_again)
      std::copy(found.begin(), found.end(), written.begin());
    else
      write_contacts(found, first == 0 ? pair->last : from(pair->last, found.front()), written, frame);
    begin += count;
  }
}

}  // namespace graze
