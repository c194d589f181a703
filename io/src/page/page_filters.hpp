#pragma once

#include <array>
#include <cstdint>
#include <graze/pair_filters.hpp>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "page/page_objects.hpp"
#include "text/json_text.hpp"

namespace graze::io {

/// Items, each with the frames in which it holds. Frames are counted in calls of PageWriter::frame().
template <typename Item>
class HeldItems {
 public:
  struct Held {
    Item item;
    std::uint64_t begin = 0;
    std::optional<std::uint64_t> end;
  };

  /// From this frame on just these items hold.
  void set(const std::set<Item>& items, std::uint64_t frame) {
    std::erase_if(now_, [&](const auto& held) {
      const bool is_over = !items.contains(held.first);
      if (is_over) past_.push_back({held.first, held.second, frame});
      return is_over;
    });
    for (const Item& item : items) now_.emplace(item, frame);
  }
  [[nodiscard]] std::vector<Held> all() const {
    std::vector<Held> all = past_;
    for (const auto& [item, begin] : now_) all.push_back({item, begin, std::nullopt});
    return all;
  }

 private:
  std::map<Item, std::uint64_t> now_;  ///< with the frame from which each holds
  std::vector<Held> past_;
};

/// What a page says of pairs: which are ignored, and the thresholds of kinds.
class PageFilters {
 public:
  /// From this frame on these hold. What names an object that the page does not have is left out.
  void set(const PairFilters& filters, const PageObjects& objects, std::uint64_t frame);
  /// Writes the lists that have entries, for a page that has each of `every` frames, and `count` of them.
  void write(JsonText& json, std::uint32_t every, std::uint64_t count) const;

 private:
  using Rule = std::tuple<std::array<std::uint32_t, 2>, std::optional<double>, std::optional<double>,
                          std::vector<double>>;

  HeldItems<std::array<std::uint32_t, 2>> ignored_;         ///< indices of objects
  HeldItems<std::array<std::uint32_t, 4>> ignored_groups_;  ///< an object and a group, twice
  HeldItems<Rule> rules_;
};

}  // namespace graze::io
