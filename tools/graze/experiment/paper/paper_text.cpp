#include "experiment/paper/paper_text.hpp"

#include "text_format.hpp"

namespace graze::tools {
namespace {

const char* scene_text(int experiment) {
  if (experiment == 1)
    return R"(Five tori and five pawns, turned at random, come together from two rings, one above the other. The tori have R = 4 r
and 32 × 24 vertices; torus and pawn are at the scale where eq. 3 gives, for one object, about the numbers of the paper's
best row, (24, 14). The paper's times: 30 to 37 ms a step in rows 1 and 2, 30 to 45 ms in rows 4 and 5, on a 3 GHz
Pentium 4.
)";
  if (experiment == 2)
    return R"(Three humans close in on each other, and a torus comes down on them. Humans are at the scale where eq. 3 gives, for one
human, about the numbers of the paper's best row for two, (25, 15); the torus (R = 4 r) has in level 1 what that row has
for human and torus, 35. The paper's times: about 25 ms a step in row 3, and 5 ms more in row 2, on a 3 GHz Pentium 4.
)";
  return R"(A cylinder comes down on a tooth that stands still. Both are at the scale where eq. 3 gives, for one object, about the
numbers of the paper's best row, (25, 13). The paper's time: 24 ms a step in row 3, on a 3 GHz Pentium 4.
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
  return "In the first step ε of levels 1 and 2 is, by eq. 3: " + text + ".\n\n";
}

const char* motion_text =
    R"(Bodies are mass-spring systems (springs along edges, and bends across them), moved by implicit Euler in the form of
Liu and others (2013), which no step makes unstable. They start with a spin and a stretch, by the seed, go to one
point, and push each other off where exact mode finds their surfaces near; where two came nearer than a quarter of a
unit, all would stand still from there on. The motion was made once, rounded to multiples of 2⁻¹⁴, and is played to all
settings alike. It is written beside this report as scene files that `graze run` plays.

)";

const char* reading_text =
    R"(**How the numbers are read.** A *collision* is a pair of leaf regions with a pair of vertices nearer than the last ε. The
truth is every pair of leaves, with squares of distances that double holds exactly. A row *finds* the collisions whose
leaves DMV reaches; DV then walks from their nearest vertices along the mesh, and *reports* the pair of leaves where
the walk ends below the last ε, also when the walk has led out of the two leaves: such reports are no collisions by this
count, and many walks end at one vertex pair. Two things the paper leaves open:

- Eq. 4's ε may be one number for a pair of objects, as it stands in its tables, or each object's own, so that a pair has
  the sum (eq. 6). Spheres of radius ε about two middle vertices touch up to a distance of twice ε, so at this scale only
  the second can find everything; the first is what `Accuracy::paper` does with a row's numbers. Both are measured.
- With at most 30 vertices a leaf, most of these meshes end at level 2, and the paper's pseudocode gives the last level
  to DV without a test: ε of level 2 then decides only where a region of level 2 still has children. If leaves, too, have
  to pass eq. 4, DV is given far fewer pairs, nearer to the counts of the paper, and more is missed.

)";

unsigned long long number(std::uint64_t value) {
  return value;
}

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
      "**What came of it.** Row 3 finds %llu of %llu collisions over all steps; with ε by eq. 3 and 6 the "
      "paper's test misses %llu, and DV is given %.3g times as many pairs of leaves. Exact mode and "
      "`within(t)` were compared with the truth for %llu pairs of objects, %llu contacts: %s. %s\n",
      number(best.found()), number(best.sum(&StepCount::truth)),
      number(results.formula.sum(&StepCount::missed)),
      static_cast<double>(results.formula.sum(&StepCount::given_to_dv)) /
          static_cast<double>(std::max<std::uint64_t>(1, best.sum(&StepCount::given_to_dv))),
      number(compared), number(contacts),
      wrong == 0 ? "recall and precision are 1 in every step" : "not all agree, see below",
      results.violations.empty() ? "Every answer of the library in paper mode is that of the paper's method "
                                   "written down a second time, plainly."
                                 : "");
}

}  // namespace

std::string text_of(int experiment, const RecordedMotion& motion, const PaperResults& results) {
  std::string text = scene_text(experiment);
  text += scale_text(results);
  text += motion_text;
  text += format("%zu steps; the mean edge is %.2f units long.\n\n", motion.frame_count(),
                 motion.mean_edge_length);
  text += reading_text;
  if (experiment == 2)
    text +=
        "As the paper suggests, the experiment is done once more with each human in six parts, head, body, "
        "arms "
        "and legs, each with a tree of its own and not looked at against the others of its body; faces are "
        "divided, so that vertices on a cut are in two parts, and collisions there count twice. Of that, one "
        "step in four is played: small parts end at level 1, all of whose pairs are tested in every step, "
        "and "
        "leaves go to DV.\n\n";
  return text + outcome(results);
}

}  // namespace graze::tools
