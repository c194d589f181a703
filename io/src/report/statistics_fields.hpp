#pragma once

#include <array>
#include <cstdint>
#include <graze/report.hpp>
#include <string_view>

namespace graze::io {

/// A count or a time of a step, by the name that it has in a report. A part is the struct that has it.
template <typename Part, typename Number>
struct StatisticsField {
  std::string_view name;
  Number Part::*member;
};
using CountField = StatisticsField<StepStatistics, std::uint64_t>;
using WorkField = StatisticsField<StepWork, std::uint64_t>;
using BytesField = StatisticsField<StepBytes, std::uint64_t>;
using TimeField = StatisticsField<StepTimes, double>;

inline constexpr std::array count_fields{
    CountField{"objects", &StepStatistics::objects},
    CountField{"objects_unread", &StepStatistics::objects_unread},
    CountField{"objects_surveyed", &StepStatistics::objects_surveyed},
    CountField{"pairs_total", &StepStatistics::pairs_total},
    CountField{"objects_in_slack", &StepStatistics::objects_in_slack},
    CountField{"pairs_close", &StepStatistics::pairs_close},
    CountField{"pairs_filtered", &StepStatistics::pairs_filtered},
    CountField{"pairs_fixed", &StepStatistics::pairs_fixed},
    CountField{"pairs_by_layer", &StepStatistics::pairs_by_layer},
    CountField{"pairs_in_group", &StepStatistics::pairs_in_group},
    CountField{"pairs_ignored", &StepStatistics::pairs_ignored},
    CountField{"pairs_apart", &StepStatistics::pairs_apart},
    CountField{"pairs_unchanged", &StepStatistics::pairs_unchanged},
    CountField{"pairs_tested", &StepStatistics::pairs_tested},
    CountField{"pairs_by_list", &StepStatistics::pairs_by_list},
    CountField{"pairs_near", &StepStatistics::pairs_near},
    CountField{"pairs_in_contact", &StepStatistics::pairs_in_contact},
    CountField{"contacts", &StepStatistics::contacts},
    CountField{"pairs_cut", &StepStatistics::pairs_cut},
    CountField{"contacts_left_out", &StepStatistics::contacts_left_out},
    CountField{"region_distances", &StepStatistics::region_distances},
    CountField{"region_distances_left_out", &StepStatistics::region_distances_left_out},
    CountField{"pairs_swept", &StepStatistics::pairs_swept},
    CountField{"impacts", &StepStatistics::impacts},
};

/// All but `regions_expanded`, which is an array.
inline constexpr std::array work_fields{
    WorkField{"boxes_tested", &StepWork::boxes_tested},
    WorkField{"region_pairs_tested", &StepWork::region_pairs_tested},
    WorkField{"leaf_pairs_tested", &StepWork::leaf_pairs_tested},
    WorkField{"discarded_in_float", &StepWork::discarded_in_float},
    WorkField{"named_in_float", &StepWork::named_in_float},
    WorkField{"decided_in_double", &StepWork::decided_in_double},
    WorkField{"exact_decisions", &StepWork::exact_decisions},
    WorkField{"fronts_left_out", &StepWork::fronts_left_out},
    WorkField{"swept_region_pairs", &StepWork::swept_region_pairs},
    WorkField{"swept_feature_pairs", &StepWork::swept_feature_pairs},
    WorkField{"swept_exact_decisions", &StepWork::swept_exact_decisions},
};

/// All but the one below.
inline constexpr std::array bytes_fields{
    BytesField{"object_bytes", &StepBytes::objects},
    BytesField{"pair_bytes", &StepBytes::pairs},
    BytesField{"report_bytes", &StepBytes::reports},
};
/// It depends on which thread did what, which is chance. So it is left out with the times.
inline constexpr BytesField thread_bytes_field{"thread_bytes", &StepBytes::threads};

inline constexpr std::array time_fields{
    TimeField{"read_ms", &StepTimes::read_ms},       TimeField{"pairs_ms", &StepTimes::pairs_ms},
    TimeField{"refit_ms", &StepTimes::refit_ms},     TimeField{"jobs_ms", &StepTimes::jobs_ms},
    TimeField{"publish_ms", &StepTimes::publish_ms}, TimeField{"step_ms", &StepTimes::step_ms},
};

static_assert(sizeof(StepWork) ==
                  sizeof(StepWork::regions_expanded) + sizeof(std::uint64_t) * work_fields.size(),
              "every count of work has a name");
static_assert(sizeof(StepBytes) == sizeof(std::uint64_t) * (bytes_fields.size() + 1),
              "every count of bytes has a name");
static_assert(sizeof(StepTimes) == sizeof(double) * time_fields.size(), "every time has a name");
static_assert(sizeof(StepStatistics) == sizeof(std::uint64_t) * count_fields.size() + sizeof(StepWork) +
                                            sizeof(StepBytes) + sizeof(StepTimes),
              "every count has a name");

}  // namespace graze::io
