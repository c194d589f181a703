#include "sweep/moving_features.hpp"

#include "sweep/double_meeting.hpp"
#include "sweep/exact_meeting.hpp"

namespace graze {
namespace {

std::optional<SweptMeeting> meet(SweptPair pair, const FeatureSweep& sweep, const SweepPrecision& precision,
                                 SweepCounters& counters) {
  const DoubleMeeting in_double = meeting_in_double(pair, sweep, precision.tolerance);
  switch (in_double.answer) {
    case DoubleMeeting::Answer::discarded:
      ++counters.discarded;
      return std::nullopt;
    case DoubleMeeting::Answer::apart:
      ++counters.in_double;
      return std::nullopt;
    case DoubleMeeting::Answer::meets:
      ++counters.in_double;
      return in_double.meeting;
    case DoubleMeeting::Answer::unsure:
      break;
  }
  ++counters.exact;
  const std::optional<SweptMeeting> meeting = exact_meeting(pair, sweep, precision.exact_budget);
  if (meeting && meeting->status == ImpactStatus::possible) ++counters.undecided;
  return meeting;
}

}  // namespace

std::optional<SweptMeeting> meet_vertex_face(const FeatureSweep& sweep, const SweepPrecision& precision,
                                             SweepCounters& counters) {
  return meet(SweptPair::vertex_face, sweep, precision, counters);
}

std::optional<SweptMeeting> meet_edge_edge(const FeatureSweep& sweep, const SweepPrecision& precision,
                                           SweepCounters& counters) {
  return meet(SweptPair::edge_edge, sweep, precision, counters);
}

}  // namespace graze
