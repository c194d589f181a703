#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace graze::tests {

/// The hash of a scene's reports (ReportHash).
struct Golden {
  std::string_view scene;
  std::uint64_t hash;
};

constexpr std::size_t golden_frames = 20;

/// Hashes of so many frames each. They are the same with any number of threads, in every run and on every
/// platform. In exact mode the contract fixes every bit of a report, so a changed hash is a
/// changed answer. One thing is not fixed: the witness of surfaces that touch, where distances alone are
/// asked for. It follows the order of leaf pairs (docs/method.md, section 2).
///
/// A change may be meant to answer otherwise. Then the program prints all hashes anew, by the command
/// `graze_studies stress --determinism --frames 20 --repeats 1`.
///
/// The scene `nearest` has the pairs of that detail alone. The scene `solids` also has sides by winding
/// numbers, and what is inside. The scene `limits` also has the order by which contacts are kept. The scene
/// `carrying` has contacts that are chosen to carry a pair, which depend on the frame before. The scene
/// `self` has surfaces that are tested against themselves. The scene `swept` has impacts, and objects that
/// jump.
inline constexpr std::array<Golden, 12> golden_hashes = {{
    {"paths", 0x2a460bba2118de22U},
    {"pile", 0xe8d81a16d3e3979fU},
    {"pair", 0xb5863d0d32c6cfbeU},
    {"skinned", 0xf86ae96fb28a0c3U},
    {"crowd", 0x989c1b434db2f3cfU},
    {"nearest", 0x6f4c8be059965339U},
    {"solids", 0x8fe1260fe132fe2aU},
    {"limits", 0xaa738c0ece2effacU},
    {"carrying", 0x75466a2b648c63a4U},
    {"seams", 0xe3de4efcb9dc092fU},
    {"self", 0x1cc7903d709ce6dfU},
    {"swept", 0xd67eae4da89bc729U},
}};

}  // namespace graze::tests
