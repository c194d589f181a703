#include "sweep/moving_features.hpp"

#include "sweep/exact_meeting.hpp"
namespace graze {
std::optional<SweptMeeting> meet_vertex_face(const FeatureSweep& sweep, const SweepPrecision& precision,
                                             SweepCounters& counters) {
  ++counters.exact;
  return exact_meeting(SweptPair::vertex_face, sweep, precision.exact_budget);
}
std::optional<SweptMeeting> meet_edge_edge(const FeatureSweep& sweep, const SweepPrecision& precision,
                                           SweepCounters& counters) {
  ++counters.exact;
  return exact_meeting(SweptPair::edge_edge, sweep, precision.exact_budget);
}
}  // namespace graze
