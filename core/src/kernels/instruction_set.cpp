#include <array>
#include <atomic>
#include <graze/error.hpp>
#include <graze/instruction_set.hpp>

#include "kernels/filter.hpp"
#include "kernels/measure.hpp"
#include "kernels/positions.hpp"
#include "kernels/voronoi.hpp"

namespace graze {
namespace kernels {

// Each table is defined by filter_<set>.cpp, measure_<set>.cpp and voronoi_<set>.cpp.
namespace scalar {
extern const Filter table;
extern const Measure measure_table;
extern const VoronoiKernels voronoi_table;
extern const PositionPasses position_passes;
}  // namespace scalar
namespace baseline {
extern const Filter table;
extern const Measure measure_table;
extern const VoronoiKernels voronoi_table;
extern const PositionPasses position_passes;
}  // namespace baseline
#ifdef GRAZE_X86_KERNELS
namespace avx2 {
extern const Filter table;
extern const Measure measure_table;
extern const VoronoiKernels voronoi_table;
extern const PositionPasses position_passes;
}  // namespace avx2
namespace avx512 {
extern const Filter table;
extern const Measure measure_table;
extern const VoronoiKernels voronoi_table;
extern const PositionPasses position_passes;
}  // namespace avx512
#endif

}  // namespace kernels

namespace {

struct Available {
  std::array<InstructionSet, 4> sets{};
  std::size_t count = 0;
};

Available find_available() {
  Available found;
  const auto add = [&](InstructionSet set) { found.sets[found.count++] = set; };
  add(InstructionSet::scalar);
  add(InstructionSet::baseline);
#ifdef GRAZE_X86_KERNELS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2")) add(InstructionSet::avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
    add(InstructionSet::avx512);
#endif
  return found;
}

const Available& available() {
  static const Available found = find_available();
  return found;
}

/// All kernels of one instruction set.
struct Tables {
  const kernels::Filter& filter;
  const kernels::Measure& measure;
  const kernels::VoronoiKernels& voronoi;
  const kernels::PositionPasses& position_passes;
};
constexpr Tables scalar_tables{kernels::scalar::table, kernels::scalar::measure_table,
                               kernels::scalar::voronoi_table, kernels::scalar::position_passes};
constexpr Tables baseline_tables{kernels::baseline::table, kernels::baseline::measure_table,
                                 kernels::baseline::voronoi_table, kernels::baseline::position_passes};
#ifdef GRAZE_X86_KERNELS
constexpr Tables avx2_tables{kernels::avx2::table, kernels::avx2::measure_table, kernels::avx2::voronoi_table,
                             kernels::avx2::position_passes};
constexpr Tables avx512_tables{kernels::avx512::table, kernels::avx512::measure_table,
                               kernels::avx512::voronoi_table, kernels::avx512::position_passes};
#endif

const Tables& tables_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::scalar:
      return scalar_tables;
    case InstructionSet::baseline:
      return baseline_tables;
#ifdef GRAZE_X86_KERNELS
    case InstructionSet::avx2:
      return avx2_tables;
    case InstructionSet::avx512:
      return avx512_tables;
#else
    default:
      break;
#endif
  }
  return scalar_tables;
}

InstructionSet best() {
  return available().sets[available().count - 1];
}

// Code that runs before these are initialised finds zero, and with it the plain kernels, which give the same
// answers.
std::atomic<InstructionSet> set_in_use{best()};
std::atomic<const Tables*> tables_in_use{&tables_of(best())};

const Tables& in_use() {
  const Tables* const tables = tables_in_use.load(std::memory_order_relaxed);
  return tables != nullptr ? *tables : scalar_tables;
}

}  // namespace

const kernels::Filter& kernels::filter() {
  return in_use().filter;
}
const kernels::Measure& kernels::measure() {
  return in_use().measure;
}
const kernels::VoronoiKernels& kernels::voronoi() {
  return in_use().voronoi;
}
const kernels::PositionPasses& kernels::position_passes() {
  return in_use().position_passes;
}

std::string_view to_string(InstructionSet set) {
  constexpr std::array<std::string_view, 4> names{"scalar", "baseline", "avx2", "avx512"};
  return names[static_cast<std::size_t>(set)];
}

std::span<const InstructionSet> available_instruction_sets() {
  return {available().sets.data(), available().count};
}

InstructionSet instruction_set() {
  return set_in_use.load(std::memory_order_relaxed);
}

void use_instruction_set(InstructionSet set) {
  for (const InstructionSet known : available_instruction_sets()) {
    if (known != set) continue;
    set_in_use.store(set, std::memory_order_relaxed);
    tables_in_use.store(&tables_of(set), std::memory_order_relaxed);
    return;
  }
  throw Error("this processor or this build has no kernels for instruction set " +
              std::string(static_cast<std::size_t>(set) < 4 ? to_string(set) : "of an unknown number"));
}

}  // namespace graze
