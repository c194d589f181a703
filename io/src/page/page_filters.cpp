#include "page/page_filters.hpp"

#include "page/page_block.hpp"

namespace graze::io {
namespace {

/// Calls `write(item, first, last)` for each item that holds in frames of the page, between brackets.
template <typename Item, typename Write>
void write_held(JsonText& json, std::string_view key, const HeldItems<Item>& items, std::uint32_t every,
                std::uint64_t count, const Write& write) {
  bool has_any = false;
  for (const auto& [item, begin, end] : items.all()) {
    const std::uint64_t first = page_frames_before(begin, every);
    const std::uint64_t behind = end ? page_frames_before(*end, every) : count;
    if (first >= behind) continue;
    if (!has_any) json.key(key).open('[');
    has_any = true;
    write(item, first, behind - 1);
  }
  if (has_any) json.close(']');
}

}  // namespace

void PageFilters::set(const PairFilters& filters, const PageObjects& objects, std::uint64_t frame) {
  std::set<std::array<std::uint32_t, 2>> ignored;
  for (const auto& [id_a, id_b] : filters.ignored) {
    const auto a = objects.index_of(id_a);
    const auto b = objects.index_of(id_b);
    if (a && b) ignored.insert({*a, *b});
  }
  std::set<std::array<std::uint32_t, 4>> groups;
  for (const auto& [group_a, group_b] : filters.ignored_groups) {
    const auto a = objects.index_of(group_a.object);
    const auto b = objects.index_of(group_b.object);
    if (a && b) groups.insert({*a, group_a.group, *b, group_b.group});
  }
  std::set<Rule> rules;
  for (const auto& [kind_a, kind_b, rule] : filters.rules)
    rules.emplace(std::array{kind_a, kind_b}, rule.contact_distance, rule.range, rule.epsilon);
  ignored_.set(ignored, frame);
  ignored_groups_.set(groups, frame);
  rules_.set(rules, frame);
}

void PageFilters::write(JsonText& json, std::uint32_t every, std::uint64_t count) const {
  const auto write_numbers = [&](const auto& numbers, std::uint64_t first, std::uint64_t last) {
    json.open('[');
    for (const std::uint32_t number : numbers) json.whole(number);
    json.whole(first).whole(last).close(']');
  };
  write_held(json, "ignored", ignored_, every, count, write_numbers);
  write_held(json, "ignored_groups", ignored_groups_, every, count, write_numbers);
  write_held(json, "rules", rules_, every, count,
             [&](const Rule& rule, std::uint64_t first, std::uint64_t last) {
               const auto& [kinds, contact_distance, range, epsilon] = rule;
               json.open('{').key("kinds").open('[').whole(kinds[0]).whole(kinds[1]).close(']');
               if (contact_distance) json.key("contact_distance").real(*contact_distance);
               if (range) json.key("range").real(*range);
               if (!epsilon.empty()) {
                 json.key("epsilon").open('[');
                 for (const double number : epsilon) json.real(number);
                 json.close(']');
               }
               json.key("first").whole(first).key("last").whole(last).close('}');
             });
}

}  // namespace graze::io
