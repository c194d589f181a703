#pragma once

#include <array>
#include <graze/report.hpp>
#include <string_view>
#include <utility>

namespace graze::io {

/// The counters and times of a step by the names they have in a report, in the order in which they are
/// written. `regions_expanded` is an array and stands between the two.
inline constexpr std::array<std::pair<std::string_view, std::uint64_t StepStatistics::*>, 33> counter_fields{{
    {"objects", &StepStatistics::objects},
    {"objects_unread", &StepStatistics::objects_unread},
    {"objects_surveyed", &StepStatistics::objects_surveyed},
    {"pairs_total", &StepStatistics::pairs_total},
    {"objects_in_slack", &StepStatistics::objects_in_slack},
    {"boxes_tested", &StepStatistics::boxes_tested},
    {"pairs_close", &StepStatistics::pairs_close},
    {"pairs_filtered", &StepStatistics::pairs_filtered},
    {"pairs_fixed", &StepStatistics::pairs_fixed},
    {"pairs_by_layer", &StepStatistics::pairs_by_layer},
    {"pairs_in_group", &StepStatistics::pairs_in_group},
    {"pairs_ignored", &StepStatistics::pairs_ignored},
    {"pairs_apart", &StepStatistics::pairs_apart},
    {"pairs_unchanged", &StepStatistics::pairs_unchanged},
    {"pairs_tested", &StepStatistics::pairs_tested},
    {"pairs_by_list", &StepStatistics::pairs_by_list},
    {"pairs_near", &StepStatistics::pairs_near},
    {"pairs_in_contact", &StepStatistics::pairs_in_contact},
    {"contacts", &StepStatistics::contacts},
    {"pairs_cut", &StepStatistics::pairs_cut},
    {"contacts_left_out", &StepStatistics::contacts_left_out},
    {"region_pairs_tested", &StepStatistics::region_pairs_tested},
    {"leaf_pairs_tested", &StepStatistics::leaf_pairs_tested},
    {"discarded_in_float", &StepStatistics::discarded_in_float},
    {"named_in_float", &StepStatistics::named_in_float},
    {"decided_in_double", &StepStatistics::decided_in_double},
    {"exact_decisions", &StepStatistics::exact_decisions},
    {"fronts_left_out", &StepStatistics::fronts_left_out},
    {"region_distances", &StepStatistics::region_distances},
    {"region_distances_left_out", &StepStatistics::region_distances_left_out},
    {"object_bytes", &StepStatistics::object_bytes},
    {"pair_bytes", &StepStatistics::pair_bytes},
    {"report_bytes", &StepStatistics::report_bytes},
}};

/// A statistic that depends on which thread did what, which is chance. It is left out with the times.
inline constexpr std::pair<std::string_view, std::uint64_t StepStatistics::*> thread_field{
    "thread_bytes", &StepStatistics::thread_bytes};

inline constexpr std::array<std::pair<std::string_view, double StepStatistics::*>, 6> time_fields{{
    {"read_ms", &StepStatistics::read_ms},
    {"pairs_ms", &StepStatistics::pairs_ms},
    {"refit_ms", &StepStatistics::refit_ms},
    {"jobs_ms", &StepStatistics::jobs_ms},
    {"publish_ms", &StepStatistics::publish_ms},
    {"step_ms", &StepStatistics::step_ms},
}};

static_assert(sizeof(StepStatistics) ==
                  sizeof(StepStatistics::regions_expanded) +
                      sizeof(std::uint64_t) * (counter_fields.size() + 1 + time_fields.size()),
              "every statistic has a name");

}  // namespace graze::io
