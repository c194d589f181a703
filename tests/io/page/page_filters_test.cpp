// What the head of a page says of pairs: which are ignored, and the thresholds of kinds, each with its
// frames.

#include <graze/io/page.hpp>
#include <limits>

#include "io/page/page_decoder.hpp"
#include "io/page/page_play.hpp"
#include "support/catch.hpp"
#include "tools/temporary_folder.hpp"

using namespace graze::tests;
namespace io = graze::io;

namespace {

using nlohmann::json;

constexpr graze::ObjectId first{0, 1};
constexpr graze::ObjectId second{1, 1};
constexpr graze::ObjectId third{2, 1};

/// A page of empty frames with three objects.
class FilteredPage {
 public:
  explicit FilteredPage(std::uint32_t every = 1)
      : page_(folder_ / "view.grazeview", {}, {.settings = {}, .every = every}) {
    for (const graze::ObjectId id : {first, second, third}) add(id);
  }
  void add(graze::ObjectId id) { page_.add_object(id, {.name = "plate", .mesh = grid(2)}); }
  void remove(graze::ObjectId id) { page_.remove_object(id); }
  void say(const graze::PairFilters& filters) { page_.set_pair_filters(filters); }
  void frames(int count) {
    for (int i = 0; i < count; ++i) page_.frame(0, {});
  }
  [[nodiscard]] json head() {
    page_.close();
    return DecodedPage(folder_ / "view.grazeview").head();
  }

 private:
  TemporaryFolder folder_;
  io::PageWriter page_;
};

}  // namespace

TEST_CASE("page filters: a page of which nothing is said has no lists") {
  FilteredPage page;
  page.say({});
  page.frames(2);
  const json head = page.head();
  for (const char* const key : {"ignored", "ignored_groups", "rules"}) CHECK_FALSE(head.contains(key));
}

TEST_CASE("page filters: pairs and groups are in the frames for which they were said") {
  FilteredPage page;
  page.frames(1);
  page.say({.ignored = {{first, second}}, .ignored_groups = {{{third, 7}, {first, 2}}}});
  page.frames(2);
  page.say({.ignored = {{first, second}, {third, second}}});
  page.frames(3);
  const json head = page.head();
  CHECK(head.at("ignored") == json{{0, 1, 1, 5}, {2, 1, 3, 5}});
  CHECK(head.at("ignored_groups") == json::array({{2, 7, 0, 2, 1, 2}}));
}

TEST_CASE("page filters: rules have the thresholds that were said") {
  FilteredPage page;
  page.say({.rules = {{1, 2, {.contact_distance = 0.5}},
                      {3, 3, {.range = std::numeric_limits<double>::infinity(), .epsilon = {1, 0.25}}}}});
  page.frames(2);
  page.say({.rules = {{1, 2, {.contact_distance = 0.25}}}});
  page.frames(1);
  const json rules = page.head().at("rules");
  CHECK(rules ==
        json{{{"kinds", {1, 2}}, {"contact_distance", 0.5}, {"first", 0}, {"last", 1}},
             {{"kinds", {3, 3}}, {"range", "infinity"}, {"epsilon", {1, 0.25}}, {"first", 0}, {"last", 1}},
             {{"kinds", {1, 2}}, {"contact_distance", 0.25}, {"first", 2}, {"last", 2}}});
}

TEST_CASE("page filters: frames are those of the page, which has each third one") {
  FilteredPage page(3);
  page.frames(1);
  page.say({.ignored = {{first, second}}});
  page.frames(2);
  page.say({.ignored = {{first, third}}});
  page.frames(4);
  CHECK(page.head().at("ignored") == json::array({{0, 2, 1, 2}}));
}

TEST_CASE("page filters: an id is its last object, and unknown ids are left out") {
  FilteredPage page;
  page.say({.ignored = {{first, second}, {first, {9, 1}}}});
  page.frames(2);
  page.remove(second);
  page.add(second);
  page.say({.ignored = {{first, second}}});
  page.frames(1);
  CHECK(page.head().at("ignored") == json{{0, 1, 0, 1}, {0, 3, 2, 2}});
}
