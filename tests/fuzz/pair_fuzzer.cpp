// Two small surfaces, every detail and accuracy, against brute force in exact arithmetic. A scene that fails
// is reduced and printed as C++.

#include "byte_reader.hpp"
#include "finding.hpp"
#include "fuzz/pair/pair_case.hpp"

namespace graze::fuzz {
namespace {

void run(ByteReader reader) {
  const PairCase given = read_pair_case(reader);
  const auto judge = [&](const tests::TwoShapes& shapes) { return pair_difference(shapes, given.ask); };
  const std::string difference = judge(given.shapes);
  if (!difference.empty())
    finding(difference + "reduced, " + text_of(given.ask) + tests::reduced_text(given.shapes, judge));
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run(graze::fuzz::ByteReader({data, size}));
  return 0;
}
