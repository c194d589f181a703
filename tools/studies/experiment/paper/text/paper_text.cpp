#include "experiment/paper/text/paper_text.hpp"

#include "output/text.hpp"

namespace graze::tools {
namespace {

const char* scene_text(int experiment) {
  if (experiment == 1)
    return R"(**What was measured.** Five tori and five pawns, turned at random, come together from two rings, one above the other.

| condition | value |
| :-- | :-- |
| tori | R = 4 r, 32 × 24 vertices |
| scale of torus and pawn | eq. 3 gives, for one object, about the numbers of the paper's best row, (24, 14) |
| the paper's times, 3 GHz Pentium 4 | 30 to 37 ms a step in rows 1 and 2, 30 to 45 ms in rows 4 and 5 |
)";
  if (experiment == 2)
    return R"(**What was measured.** Three humans close in on each other, and a torus comes down on them.

| condition | value |
| :-- | :-- |
| scale of the humans | eq. 3 gives, for one human, about the numbers of the paper's best row for two, (25, 15) |
| scale of the torus, R = 4 r | ε of level 1 is what the paper's best row has for human and torus, 35 |
| the paper's times, 3 GHz Pentium 4 | about 25 ms a step in row 3, and 5 ms more in row 2 |
)";
  return R"(**What was measured.** A cylinder comes down on a tooth that stands still.

| condition | value |
| :-- | :-- |
| scale of both | eq. 3 gives, for one object, about the numbers of the paper's best row, (25, 13) |
| the paper's time, 3 GHz Pentium 4 | 24 ms a step in row 3 |
)";
}

/// Eq. 3 in the first step.
std::string scale_text(const PaperResults& results) {
  std::string text;
  for (const EscapeCount& count : results.escapes)
    if (count.level <= 2) {
      text += count.level == 1 ? (text.empty() ? "" : "; ") + count.kind + " " : ", ";
      text += format("%.1f", count.epsilon);
    }
  return "| ε of levels 1 and 2 by eq. 3, first step | " + text + " |\n";
}

const char* motion_text = "| motion | [made once, by springs](#motion) |\n";

const char* reading_text = "\nThe words below are explained under [terms](#terms).\n\n";

std::string outcome(const PaperResults& results) {
  std::uint64_t compared = 0;
  std::uint64_t contacts = 0;
  std::uint64_t wrong = 0;
  for (const ContactCheck& check : results.checks) {
    compared += check.compared;
    contacts += check.contacts_true;
    wrong += check.wrong + check.distances_wrong;
  }
  const RowResult& best = results.rows[best_row];
  return format(
      "**Result.** Over all steps:\n\n"
      "| what | result |\n| :-- | :-- |\n"
      "| collisions that row 3 finds | %llu of %llu |\n"
      "| collisions that the paper's test misses with ε by eq. 3 and 6 | %llu |\n"
      "| leaf pairs that it then gives DV, beside row 3 | %.3g times as many |\n"
      "| pairs of objects for which exact mode and `within(t)` were compared with the truth | %llu |\n"
      "| contacts compared | %llu |\n"
      "| outcome of that comparison | %s |\n\n%s\n",
      number(best.found()), number(best.sum(&StepCount::truth)),
      number(results.formula.sum(&StepCount::missed)),
      static_cast<double>(results.formula.sum(&StepCount::given_to_dv)) /
          static_cast<double>(std::max<std::uint64_t>(1, best.sum(&StepCount::given_to_dv))),
      number(compared), number(contacts),
      wrong == 0 ? "recall and precision are 1 in every step" : "not all agree, see below",
      results.violations.empty() ? "In paper mode every answer of the library equals that of a second, plain "
                                   "implementation of the paper's method."
                                 : "");
}

}  // namespace

std::string text_of(int experiment, const RecordedMotion& motion, const PaperResults& results) {
  std::string text = scene_text(experiment);
  text += scale_text(results);
  text += motion_text;
  text += format("| steps | %zu |\n| mean edge length | %.2f units |\n", motion.frame_count(),
                 motion.mean_edge_length);
  text += reading_text;
  if (experiment == 2)
    text +=
        "As the paper suggests, the experiment is played once more with each human in six parts: head, "
        "body, arms and legs. Each part has a tree of its own and is not tested against the other parts "
        "of its body. The parts share out the faces. A vertex on a cut is in two parts, so collisions "
        "there count twice.\n\n"
        "With parts only one step in four is played, because paper mode takes long there. Small parts end "
        "at level 1, all pairs of level 1 are tested in every step, and leaves go to DV.\n\n";
  return text + outcome(results);
}

}  // namespace graze::tools
