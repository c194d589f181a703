#include "accuracy/page.hpp"

#include "accuracy/tables.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

const char* introduction =
    R"(# Accuracy

This page shows how large every remaining error of graze is. `graze_studies accuracy` measures all of it anew and writes the page.

The truth is an oracle that shares no code with the library. It compares every pair of features by brute force in exact
rational arithmetic: coordinates, distances and points are fractions. The library is used through its public interface
alone.

The command fails unless all of this holds:

| what must hold | where this page shows it |
| :-- | :-- |
| no wrong name: the set of contacts and their kinds are those of real arithmetic, in every detail | *wrong names* is 0 |
| every distance of a contact is within 2^-48 of the size of its two features plus their gap | *largest* is at most 32 |
| in exact mode a pair's bounds are its true distance rounded down and up | *wrong bounds* is 0 |
| in every other mode a pair's bounds hold its true distance | *broken bounds* is 0 |

)";

const char* kernel_text =
    R"(## Kernels

A kernel is what measures one kind of contact. Each is fed three kinds of input, all about 1 in size:

| kind of input | what it holds |
| :-- | :-- |
| random | two faces (triangles, flat and warped quads) or small meshes at random positions; exactly parallel features in random directions where a kernel needs them |
| nearly degenerate | input 2^20 to 2^40 from the origin |
| | needles of aspect 10^3 to 10^9; exactly parallel needles |
| | copies turned by 10^-15 to 10^-3; copies one or two units in the last place off; parallel faces moved by units in the last place |
| | corners almost over a border, where the kind of contact changes |
| | a face 10^2 to 10^7 times smaller than the other |
| degenerate | coarse grids, where ties are common |
| | faces without area; repeated and coincident corners |
| | corners exactly on corners, edges and faces; coplanar and collinear overlap |

In one scene of four the threshold is the distance of one of its contacts, or the double before or after that.

Two tables follow for each kind of input. Their rows are these kernels:

| kernels | detail of their contacts |
| :-- | :-- |
| edge along edge, edge along face, face over face | `closest`: the parallel contacts |
| vertex sets | `vertices` |
| fold of a quad | `features`, on the diagonal of a quad that is not flat |
| all others | `features` |

The first table is about names and distances:

| column | meaning |
| :-- | :-- |
| contacts | how many were compared |
| wrong names | contacts reported that are not there, and contacts that are there and not reported |
| largest, mean | error of the distance in units of 2^-53 times (the size of both features plus their gap) |
| largest, absolute | in units of length; everything is about 1 in size, the gaps between 0 and 2 |
| largest, relative | the largest error in parts of the distance itself |

The contract allows 32 units of the distance's error. Writing a distance down costs up to 1 of these units where the gap is
all of the size, as between vertices. Distances far below the rounding of the coordinates have few correct digits, or none,
as doubles. Their error is small by size, not by distance.

The second table is about points and normals:

| column | meaning |
| :-- | :-- |
| points | how far `point_a` and `point_b` are from the true closest points, in units |
| apart | how far the distance between the two points is from the true distance, in units |
| normal, angle | the angle in radians between `normal` and the true direction |
| normal, length − 1 | how far `normal` is from length 1 |

A unit is 2^-53 times (the size of both features, their gap and the point's largest coordinate). Writing a point down costs
up to 1.7 of these units. For the last three kernels the true point is the middle of the closest stretch or area.

The angle is taken where one formula of the positions gives the true direction. That is the direction along the gap. At
distance 0 it is the face's normal, or the direction across both edges.

)";

const char* parallel_text =
    R"(The points of *edge along face* and *face over face* are far from the true ones in some scenes. The reason is that the
middle of an area is ill-conditioned where the area is a needle: moving a corner by an ulp moves the area's ends by many
ulps. The same goes for the stretch of an edge over it. Where an area is thinner than 2^-40 of its length, graze reports
the middle of its longest chord in place of its centroid ([method.md](method.md)). That point is up to a sixth of the
length away.

The two points still are as far apart as they should be (column *apart*). The distance and the normal of such a contact are
as exact as any.

)";

const char* mode_text =
    R"(## Accuracy settings

The paper's five models are the torus, pawn, human, tooth and cylinder, of 258 to 1,202 vertices each. They bend, twist and
turn while they come together until they interpenetrate, and part again. All ten pairs are listed in every frame.

| column | meaning |
| :-- | :-- |
| complete | pairs that no budget cut short |
| found | of the contacts of exact mode in the same detail, how many the setting reports |
| right | of the contacts that the setting reports, how many are truly below the contact distance |
| touching found | of the pairs of models in contact, how many the setting says are |
| width | upper − lower of the pairs' bounds, in mean edge lengths |
| above truth, below truth | upper − true distance, and true distance − lower, in mean edge lengths |
| broken bounds | pairs whose true distance is not between lower and upper |
| region pairs | how many pairs of regions a step tests, the measure of work that is the same on every machine |

What to know of a setting or a detail:

- **`within`**: the distances of pairs in contact stay exact.
- **Budgets**: a budget is for each step, and is a part of what exact mode takes on average. Frames where the models
  interpenetrate take more. A pair that is cut short has looser bounds, at worst those of the two models' boxes.
- **`none`**: no contacts are asked for, so none can be missing.
- **`regions` and `vertices`**: distances are between vertices.
- **`regions` in paper settings**: *found* compares names. The paper's DV walks on from the closest vertices of two leaves
  to nearer neighbours. So several pairs of leaves end at one contact, and that may be another leaf's. *Touching found* and
  *right* are not affected.
- **`vertices` in paper settings**: what is missing the paper's test of middle vertices (eq. 4) has cut off.
- **Numbers of the paper's test**: they are parts of the most that eq. 6 gives for these models at rest. The last number,
  DV's, is the contact distance or a multiple of it.

| condition | value |
| :-- | :-- |
)";

std::string kernel_sections(const AccuracyResults& results) {
  static constexpr std::array<const char*, 3> titles = {"Random input", "Nearly degenerate input",
                                                        "Degenerate input"};
  std::string text;
  for (const InputKind input : all_input_kinds) {
    const auto index = static_cast<std::size_t>(input);
    const KernelStudy& study = results.kernels[index];
    text += std::string("### ") + titles[index] + "\n\n";
    text +=
        format("%llu scenes. Names and distances:\n\n", number(study.scenes)) + kernel_distance_table(study);
    text += "Points and normals:\n\n" + kernel_point_table(study);
    if (input == InputKind::nearly_degenerate) text += parallel_text;
  }
  return text;
}

std::string decision_section(const AccuracyResults& results) {
  return "### Pairs and decisions\n\n"
         "A pair is asked for the distance of its surfaces and for that of its vertices. Its bounds are "
         "wrong unless they are the true distance rounded down and up. The table also says how the "
         "questions of all details were settled:\n\n"
         "| column | meaning |\n| :-- | :-- |\n"
         "| discarded in float | pairs of features or vertices of two leaves that float arithmetic found "
         "too far |\n"
         "| named in float | contacts that float arithmetic named |\n"
         "| decided in double | questions that double arithmetic decided |\n"
         "| exact decisions | questions that double arithmetic left open, and exact arithmetic decided |\n"
         "| exact, of those | exact decisions / (named in float + decided in double + exact decisions) "
         "|\n\n"
         "On degenerate input many questions are ties, which no rounded arithmetic can decide. These "
         "meshes are tiny and made to be hard: a step's statistics have the counts of a real scene.\n\n" +
         decision_table(results);
}

std::string detail_title(ContactDetail detail) {
  switch (detail) {
    case ContactDetail::none:
      return "### Distances of surfaces (`none`)\n\n";
    case ContactDetail::features:
      return "### Contacts of surfaces (`features`)\n\n";
    case ContactDetail::regions:
      return "### Contacts of regions (`regions`)\n\n";
    default:
      return "### Contacts of vertices (`vertices`)\n\n";
  }
}

std::string mode_sections(const AccuracyResults& results) {
  std::string text = mode_text;
  text += format("| frames | %u |\n| mean edge length at rest | %.4f |\n| contact distance | %.4f |\n",
                 results.frames, results.edge_length, results.contact_distance);
  text += "| the most that eq. 6 gives at rest, levels 1 and deeper |";
  for (std::size_t level = 1; level < results.level_epsilon.size(); ++level)
    text += format("%s %.4f", level == 1 ? "" : ",", results.level_epsilon[level]);
  text += " |\n\n";
  text += format(
      "The truth is exact mode. The oracle checked here that exact mode is right:\n\n"
      "| check | count |\n| :-- | --: |\n"
      "| pairs of all frames, their bounds between surfaces and between vertices to the last bit | %llu "
      "of %llu |\n"
      "| contacts of `features`, `regions` and `vertices`, by name | %llu |\n"
      "| wrong | %llu |\n\n",
      number(results.truth.checked), number(results.truth.pair_rows), number(results.truth.contacts),
      number(results.truth.wrong));
  for (const ModeTable& table : results.modes)
    text += detail_title(table.detail) + mode_table(table.results, results.frames);
  return text;
}

std::string time_section(const AccuracyResults& results, const std::string& figure) {
  std::string text =
      "## Time\n\nTimes are of the machine that wrote this page, of an optimised build and one thread. "
      "Each is the mean over the frames, and each frame's time is the fastest of ";
  text += format(
      "%u runs. For the same seed the rest of this page is the same on every machine. The times in this "
      "section are not, and neither are the answers under time budgets.\n\n",
      results.runs);
  text += "![time against error](" + figure +
          ")\n\nLeft: how wide the bounds of distances are on average. Those of exact mode are "
          "neighbouring doubles. Right: the share of contacts that is missing. Paper settings are those "
          "of the detail `vertices`.\n\n";
  for (const ModeTable& table : results.modes) {
    text += detail_title(table.detail) + time_table(table);
    if (!table.timed.empty()) text += "What time budgets give:\n\n" + mode_table(table.timed, results.frames);
  }
  return text;
}

}  // namespace

std::string page_of(const AccuracyResults& results, const std::string& figure) {
  std::string text = introduction;
  text += format("This page: seed %llu, %llu scenes of each kind of input.\n\n", number(results.seed),
                 number(results.kernels[0].scenes));
  text += kernel_text + kernel_sections(results) + decision_section(results) + mode_sections(results);
  if (!figure.empty()) text += time_section(results, figure);
  text.pop_back();  // one newline ends the file
  return text;
}

}  // namespace graze::tools
