#include "borders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graze::cluster {
namespace {

/// The room to move in a box that others know, in parts of its longest side. The box is told again when the
/// object leaves it.
constexpr double room_to_move = 1.0 / 8;

/// A bit that is mixed from a number, by a step of the generator SplitMix64. Bits of one product alone follow
/// each other too regularly: then one rank had nearly all pairs at the border of some grids.
bool mixed_bit(Number number) {
  number += 0x9E3779B97F4A7C15U;
  number = (number ^ (number >> 30U)) * 0xBF58476D1CE4E5B9U;
  number = (number ^ (number >> 27U)) * 0x94D049BB133111EBU;
  return ((number ^ (number >> 31U)) & 1U) != 0;
}

bool contains(const Box& box, const Box& other) {
  return (box.min.array() <= other.min.array()).all() && (other.max.array() <= box.max.array()).all();
}

double longest_side(const Box& box) {
  return (box.max - box.min).maxCoeff();
}

Box with_room(const Box& needed) {
  const double side = longest_side(needed);
  return std::isfinite(side) ? grown(needed, room_to_move * side) : needed;
}

// The bits of PairPlace. Own objects offer and seek `own`, and offer their mixed bit. A ghost seeks the own
// objects whose pairs with it are tested here.
constexpr std::uint8_t own = 1;
constexpr std::uint8_t bit_of(bool is_set) {
  return is_set ? 4 : 2;
}

}  // namespace

bool higher_rank_has(Number one, Number other) {
  return mixed_bit(one) != mixed_bit(other);
}

PairPlace place_of_own(Number number) {
  return {static_cast<std::uint8_t>(own | bit_of(mixed_bit(number))), own};
}

PairPlace place_of_ghost(Number number, int of, int here) {
  // The bit of an own object for which higher_rank_has says this rank.
  return {0, bit_of(here > of ? !mixed_bit(number) : mixed_bit(number))};
}

void Borders::begin_step(std::span<const OwnBox> boxes) {
  extent_ = {};
  auto known = loose_.begin();
  const auto drop_before = [&](Number number) {
    while (known != loose_.end() && known->first < number) known = loose_.erase(known);
  };
  for (const OwnBox& box : boxes) {
    drop_before(box.number);
    if (known == loose_.end() || known->first != box.number) {
      known = loose_.emplace_hint(known, box.number, Loose{with_room(box.needed), ++versions_, box.traits});
    } else if (Loose& loose = known->second;
               !contains(loose.box, box.needed) || longest_side(loose.box) > 2 * longest_side(box.needed)) {
      loose.box = with_room(box.needed);
      loose.version = ++versions_;
    }
    extent_.add(known->second.box);
    ++known;
  }
  drop_before(std::numeric_limits<Number>::max());
}

void Borders::tell(int rank, const Box& extent, ByteBuffer& message) {
  Neighbour& neighbour = neighbours_[rank];
  std::vector<Number> gone;
  std::map<Number, std::uint64_t> told;
  ByteBuffer news;
  std::uint64_t count = 0;
  auto before = neighbour.told.begin();
  const auto pass_before = [&](Number number) {
    for (; before != neighbour.told.end() && before->first < number; ++before) gone.push_back(before->first);
  };
  for (const auto& [number, loose] : loose_) {
    if (!do_meet(loose.box, extent)) continue;
    pass_before(number);
    const bool is_known = before != neighbour.told.end() && before->first == number;
    const bool is_current = is_known && before->second == loose.version;
    if (is_known) ++before;
    told.emplace_hint(told.end(), number, loose.version);
    if (is_current) continue;
    const FilterTraits& traits = loose.traits;
    write_fields(news, NearObject{number, numbers_of(loose.box), traits.group, traits.layer,
                                  traits.collides_with, traits.is_fixed});
    ++count;
  }
  pass_before(std::numeric_limits<Number>::max());
  neighbour.has_changed = neighbour.has_changed || count > 0 || !gone.empty();
  neighbour.told = std::move(told);
  write_fields(message, gone, count);
  message.append(news.bytes());
}

void Borders::hear(int rank, std::span<const std::byte> message) {
  Neighbour& neighbour = neighbours_[rank];
  ByteSource source(message);
  std::vector<Number> gone;
  std::uint64_t count = 0;
  source(gone, count);
  neighbour.has_changed = neighbour.has_changed || count > 0 || !gone.empty();
  for (const Number number : gone) neighbour.heard.erase(number);
  for (; count > 0; --count) {
    NearObject near;
    source(near);
    const FilterTraits traits{near.group, near.layer, near.collides_with, near.is_fixed, {}};
    neighbour.heard[near.number] = {box_of(near.box), 0, traits};
  }
}

const std::set<Number>& Borders::wanted_by(int rank) {
  Neighbour& neighbour = neighbours_[rank];
  if (neighbour.has_changed) find_wanted(rank, neighbour);
  neighbour.has_changed = false;
  return neighbour.wanted;
}

/// Sorts the boxes of both sides along x and looks at those that overlap there.
void Borders::find_wanted(int rank, Neighbour& neighbour) const {
  struct Entry {
    const Loose* loose;
    Number number;
    bool is_own;
  };
  std::vector<Entry> entries;
  for (const auto& [number, version] : neighbour.told) entries.push_back({&loose_.at(number), number, true});
  for (const auto& [number, loose] : neighbour.heard) entries.push_back({&loose, number, false});
  std::sort(entries.begin(), entries.end(), [](const Entry& left, const Entry& right) {
    return std::pair(left.loose->box.min.x(), left.number) <
           std::pair(right.loose->box.min.x(), right.number);
  });
  neighbour.wanted.clear();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = i + 1; j < entries.size(); ++j) {
      if (entries[j].loose->box.min.x() > entries[i].loose->box.max.x()) break;
      if (entries[i].is_own == entries[j].is_own) continue;
      const Entry& mine = entries[i].is_own ? entries[i] : entries[j];
      const Entry& other = entries[i].is_own ? entries[j] : entries[i];
      if (higher_rank_has(mine.number, other.number) != (rank > rank_)) continue;
      if (do_meet(mine.loose->box, other.loose->box) &&
          lasting_verdict(mine.loose->traits, other.loose->traits) == PairVerdict::tested)
        neighbour.wanted.insert(mine.number);
    }
  }
}

}  // namespace graze::cluster
