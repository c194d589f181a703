#pragma once

#include <cstdint>

namespace graze {

/// The state of a search after a stage: it needs what is named here.
enum class SearchProgress : std::uint8_t {
  slices,      ///< that the slices of its stage are run, of which there may be none
  answered,    ///< nothing: the answer is there
  no_contact,  ///< a search for the closest points: there is no contact
  gave_up,     ///< nothing: the budget is spent before there is an answer
};

}  // namespace graze
