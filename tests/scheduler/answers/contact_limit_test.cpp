// ContactLimit: what a pair and a step may list, for each way in which its settings go together.

#include "base/contact_limit.hpp"

#include "support/catch.hpp"

namespace graze::tests {
namespace {

SceneSettings limited(std::optional<std::size_t> of_step, std::optional<std::size_t> of_pair) {
  SceneSettings settings;
  settings.detail = ContactDetail::nearest;
  settings.max_contacts = of_step;
  settings.max_contacts_per_pair = of_pair;
  return settings;
}

}  // namespace

TEST_CASE("contact limit: a search keeps no more than the lower of both limits") {
  CHECK(ContactLimit(limited({}, {})).of_search() == 0);
  CHECK(ContactLimit(limited(7, {})).of_search() == 7);
  CHECK(ContactLimit(limited({}, 3)).of_search() == 3);
  CHECK(ContactLimit(limited(7, 3)).of_search() == 3);
  CHECK(ContactLimit(limited(2, 3)).of_search() == 2);
}

TEST_CASE("contact limit: a step with a limit has room for what it has not listed yet") {
  const ContactLimit none(limited({}, 3));
  CHECK(!none.is_shared());
  CHECK(none.of_further(10, 1000) == 10);
  const ContactLimit seven(limited(7, 3));
  CHECK(seven.is_shared());
  CHECK(seven.of_further(2, 4) == 2);
  CHECK(seven.of_further(10, 4) == 3);
  CHECK(seven.of_further(10, 9) == 0);
}

TEST_CASE("contact limit: those that carry are chosen out of all, and a lower limit of a pair cuts them") {
  SceneSettings settings = limited(7, 3);
  settings.carrying = 4;
  const ContactLimit cut(settings);
  CHECK(cut.of_search() == 0);
  CHECK(cut.cuts_carrying());
  CHECK(cut.carrying_rule(0.5).most == 3);
  CHECK(cut.carrying_rule(0.5).band == 0.5);
  settings.max_contacts_per_pair = 4;
  settings.carrying_band = 0.25;
  const ContactLimit whole(settings);
  CHECK(!whole.cuts_carrying());
  CHECK(whole.carrying_rule(0.5).most == 4);
  CHECK(whole.carrying_rule(0.5).band == 0.25);
  settings.detail = ContactDetail::features;
  CHECK(!ContactLimit(settings).chooses_carrying());
  CHECK(ContactLimit(settings).of_search() == 4);
}

}  // namespace graze::tests
