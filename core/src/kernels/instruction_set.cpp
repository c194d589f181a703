#include <array>
#include <atomic>
#include <graze/error.hpp>
#include <graze/instruction_set.hpp>

#include "filter.hpp"

namespace graze {
namespace kernels {

// Each is defined by filter_<set>.cpp.
namespace scalar {
extern const Filter table;
}
namespace baseline {
extern const Filter table;
}
#ifdef GRAZE_X86_KERNELS
namespace avx2 {
extern const Filter table;
}
namespace avx512 {
extern const Filter table;
}
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

const kernels::Filter& table_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::scalar:
      return kernels::scalar::table;
    case InstructionSet::baseline:
      return kernels::baseline::table;
#ifdef GRAZE_X86_KERNELS
    case InstructionSet::avx2:
      return kernels::avx2::table;
    case InstructionSet::avx512:
      return kernels::avx512::table;
#else
    default:
      break;
#endif
  }
  return kernels::scalar::table;
}

InstructionSet best() {
  return available().sets[available().count - 1];
}

// What runs before these are initialised finds zero, and with it plain code: the same answers.
std::atomic<InstructionSet> set_in_use{best()};
std::atomic<const kernels::Filter*> filter_in_use{&table_of(best())};

}  // namespace

const kernels::Filter& kernels::filter() {
  const Filter* const in_use = filter_in_use.load(std::memory_order_relaxed);
  return in_use != nullptr ? *in_use : scalar::table;
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
    filter_in_use.store(&table_of(set), std::memory_order_relaxed);
    return;
  }
  throw Error("this processor or this build has no kernels for instruction set " +
              std::string(static_cast<std::size_t>(set) < 4 ? to_string(set) : "of an unknown number"));
}

}  // namespace graze
