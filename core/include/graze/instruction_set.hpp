#pragma once

#include <cstdint>
#include <graze/export.hpp>
#include <span>
#include <string_view>

namespace graze {

/// What the float kernels are compiled for. They give the same bits with every one of them, so a report does
/// not depend on the choice. `scalar` is plain code, `baseline` what every processor of the target has (SSE2
/// on x86-64), `avx512` is F, VL, BW and DQ.
enum class InstructionSet : std::uint8_t { scalar, baseline, avx2, avx512 };

/// The enumerator's own name.
GRAZE_API std::string_view to_string(InstructionSet set);

/// Those that the processor, its operating system and this build of the library have, ascending.
GRAZE_API std::span<const InstructionSet> available_instruction_sets();

/// The one in use in the whole process: the best available, unless told otherwise. Any thread.
GRAZE_API InstructionSet instruction_set();

/// For tests and measurements: what is used in the whole process from now on. Throws Error for one that is
/// not available. Not while a scene steps or a PairDetector detects.
GRAZE_API void use_instruction_set(InstructionSet set);

}  // namespace graze
