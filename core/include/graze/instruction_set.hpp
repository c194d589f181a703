#pragma once

#include <cstdint>
#include <graze/export.hpp>
#include <span>
#include <string_view>

namespace graze {

/// @addtogroup instruction_sets
/// @{

/// The instruction sets that the float kernels are compiled for. All of them give the same bits, so a report
/// does not depend on the choice.
enum class InstructionSet : std::uint8_t {
  scalar,    ///< Plain code without vector instructions.
  baseline,  ///< The vector instructions that every processor of the target has: SSE2 on x86-64.
  avx2,      ///< AVX2.
  avx512,    ///< AVX-512 with its parts F, VL, BW and DQ.
};

/// Returns the enumerator's own name, such as "avx2".
GRAZE_API std::string_view to_string(InstructionSet set);

/// Returns the instruction sets that the processor, its operating system and this build of the library have.
/// They are in the order of the enumeration. Any thread may call it.
GRAZE_API std::span<const InstructionSet> available_instruction_sets();

/// Returns the instruction set in use in the whole process. It is the best one available, unless
/// use_instruction_set() has chosen another. Any thread may call it.
GRAZE_API InstructionSet instruction_set();

/// Chooses the instruction set for the whole process, for tests and measurements. Throws Error if `set` is
/// not available. No scene may step during the call.
GRAZE_API void use_instruction_set(InstructionSet set);

/// @}

}  // namespace graze
