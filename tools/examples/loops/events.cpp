#include "examples/loops/events.hpp"

namespace loops {

void EventCheck::take(const graze::FrameReport& report) {
  std::size_t in_contact = 0;
  for (const graze::PairReport& pair : report.pairs()) {
    const std::pair key(pair.user_data_a, pair.user_data_b);
    const bool was = touching_.count(key) > 0;
    const bool says_was = pair.phase == graze::PairPhase::touching || pair.phase == graze::PairPhase::ended;
    const bool is = pair.phase == graze::PairPhase::began || pair.phase == graze::PairPhase::touching;
    mistakes_ += was != says_was;
    began_ += pair.phase == graze::PairPhase::began;
    ended_ += pair.phase == graze::PairPhase::ended;
    in_contact += is;
    if (is) touching_.insert(key);
    if (!is) touching_.erase(key);
  }
  mistakes_ += touching_.size() != in_contact;  // a pair without a row is not in contact
}

}  // namespace loops
