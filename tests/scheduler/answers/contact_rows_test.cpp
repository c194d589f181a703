// The contacts of a report, written in stretches that know nothing of pairs, against a map of the last ones.

#include "report/contact_rows.hpp"

#include <iostream>
#include <map>
#include <set>
#include <tuple>

#include "scenes/random.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using RowKey = std::tuple<ContactKind, Feature, Feature>;
using Contacts = std::vector<Contact>;

RowKey key_of(const Contact& contact) {
  return {contact.kind, contact.feature_a, contact.feature_b};
}

RowKey any_key(scenes::Random& random, std::size_t features) {
  const auto any_feature = [&] {
    return Feature{static_cast<FeatureKind>(random.below(3)),
                   static_cast<std::uint32_t>(random.below(features))};
  };
  return {static_cast<ContactKind>(random.below(6)), any_feature(), any_feature()};
}

/// Contacts of `count` pairs of features, about half of which `last` has too.
Contacts contacts_like(scenes::Random& random, const Contacts& last, std::size_t count) {
  std::set<RowKey> keys;
  for (const Contact& contact : last)
    if (keys.size() < count / 2 && random.chance(0.5)) keys.insert(key_of(contact));
  while (keys.size() < count) keys.insert(any_key(random, count + 1));
  Contacts contacts;
  for (const auto& [kind, a, b] : keys) {
    Contact contact;
    contact.kind = kind;
    contact.feature_a = a;
    contact.feature_b = b;
    contact.distance = random.between(0, 1);
    contacts.push_back(contact);
  }
  return contacts;
}

struct PairContacts {
  Contacts last;
  Contacts now;
  bool is_again = false;
};

PairContacts any_pair(scenes::Random& random, std::size_t most) {
  PairContacts pair;
  pair.last = contacts_like(random, {}, random.below(most));
  for (Contact& contact : pair.last) contact.since = random.below(40);
  pair.is_again = random.chance(0.3);
  pair.now = pair.is_again ? pair.last : contacts_like(random, pair.last, random.below(most));
  return pair;
}

/// Checks rows that must be a pair's contacts, and says how many of those are old.
std::size_t check_rows(std::span<const Contact> rows, const PairContacts& pair, std::uint64_t frame) {
  std::map<RowKey, std::uint64_t> since;
  for (const Contact& contact : pair.last) since[key_of(contact)] = contact.since;
  std::size_t wrong = 0;
  std::size_t old = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto found = since.find(key_of(pair.now[i]));
    const bool is_right = key_of(rows[i]) == key_of(pair.now[i]) &&
                          rows[i].distance == pair.now[i].distance &&
                          rows[i].since == (found == since.end() ? frame : found->second);
    wrong += is_right ? 0U : 1U;
    old += found == since.end() ? 0U : 1U;
  }
  CHECK(wrong == 0);
  return old;
}

}  // namespace

TEST_CASE("contact rows: the contacts of few and many pairs, with any number of threads") {
  std::size_t compared = 0;
  std::size_t old = 0;
  for (const std::size_t most : {1U, 5U, 300U, 5000U})
    for (const unsigned threads : {1U, 2U, 5U}) {
      scenes::Random random(most + threads);
      std::vector<PairContacts> pairs;
      for (std::size_t total = 0; pairs.size() < 3 || (most > 1 && total < 6000);
           total += pairs.back().now.size())
        pairs.push_back(any_pair(random, most));
      constexpr std::uint64_t frame = 50;
      TaskPool tasks(threads, ArenaPolicy::own);
      ContactRows rows;
      for (int round = 0; round < 2; ++round) {  // in the memory of the first
        rows.begin();
        for (const PairContacts& pair : pairs)
          pair.is_again ? rows.add_again(pair.now) : rows.add(pair.now, pair.last);
        Contacts written(rows.count());
        rows.write(tasks, written, frame);
        std::size_t first = 0;
        for (const PairContacts& pair : pairs) {
          old += check_rows(std::span(written).subspan(first, pair.now.size()), pair, frame);
          first += pair.now.size();
        }
        CHECK(first == written.size());
        compared += first;
      }
    }
  CHECK(old > 1000);
  CHECK(compared > old + 1000);
  std::cout << "compared " << compared << " contacts, " << old << " of them old\n";
}

}  // namespace graze::tests
