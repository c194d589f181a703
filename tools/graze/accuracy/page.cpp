#include "accuracy/page.hpp"

#include "accuracy/tables.hpp"
#include "text_format.hpp"

namespace graze::tools {
namespace {

unsigned long long number(std::uint64_t value) {
  return value;
}

const char* introduction =
    R"(# Accuracy

How large every remaining error of graze is. `graze accuracy` measures all of it anew and writes this page. The truth is
an oracle in exact rational arithmetic, which shares no code with the library: brute force over every pair of features,
with coordinates, distances and points as fractions. The library is used through its public interface alone.

What has to hold, and makes the command fail otherwise:

- no wrong name: the set of contacts and their kinds are those of real arithmetic, in every detail;
- every distance of a contact is within 2^-48 of the size of its two features plus their gap;
- in exact mode a pair's bounds are its true distance rounded down and up; in every other mode they hold it.

)";

const char* kernel_text =
    R"(## Kernels

A kernel is what measures one kind of contact. Each is fed three kinds of input, all about 1 in size:

- **random**: two faces (triangles, flat and warped quads) or small meshes in random places; where a kernel needs
  features that are exactly parallel, such ones in random directions.
- **nearly degenerate**: 2^20 to 2^40 from the origin; needles of aspect 10^3 to 10^9; copies turned by 10^-15 to 10^-3;
  copies one or two units in the last place off; corners almost over a border, where the kind of contact changes; a face
  10^2 to 10^7 times smaller than the other; exactly parallel needles; parallel faces moved by units in the last place.
- **degenerate**: coarse grids, where ties are common; faces without area; repeated and coincident corners; corners
  exactly on corners, edges and faces; coplanar and collinear overlap.

In one scene of four the threshold is the distance of one of its contacts, or the double before or after that.

The first table of each kind of input is about names and distances:

| column | meaning |
| :-- | :-- |
| contacts | how many were compared |
| wrong names | contacts reported that are not there, and contacts that are there and not reported |
| largest, mean | error of the distance in units of 2^-53 times (the size of both features plus their gap). The contract allows 32. Writing a distance down costs up to 1 of these units where the gap is all of the size, as between vertices |
| largest, absolute | in units of length; everything is about 1 in size, the gaps between 0 and 2 |
| largest, relative | the largest error in parts of the distance itself. Distances far below the rounding of the coordinates have few correct digits, or none, as doubles: their error is small by size, not by distance |

The second is about points and normals:

| column | meaning |
| :-- | :-- |
| points | how far `point_a` and `point_b` are from the true closest points, in units of 2^-53 times (the size of both features, their gap and the point's largest coordinate). Writing a point down costs up to 1.7 of these units. For the last three kernels the true point is the middle of the closest stretch or area |
| apart | how far the distance between the two points is from the true distance, in the same units |
| normal, angle | the angle in radians between `normal` and the true direction, where that is one formula of the positions: along the gap; at distance 0 the face's normal, or across both edges |
| normal, length − 1 | how far `normal` is from length 1 |

*Edge along edge*, *edge along face* and *face over face* are the parallel contacts of the detail `closest`; *vertex sets*
are those of `vertices`; *fold of a quad* are those on the diagonal of a quad that is not flat. All others are found by
`features`.

)";

const char* parallel_text =
    R"(The middle of an area is ill-conditioned where the area is a needle: moving a corner by an ulp moves its ends by many,
and the same goes for the stretch of an edge over it. Where an area is thinner than 2^-40 of its length, the middle of its
longest chord is reported in place of its centroid, up to a sixth of the length away ([method.md](method.md)). The points
of *edge along face* and *face over face* say so. They still are as far apart as they should (column *apart*), and the
distance and the normal of such a contact are as exact as any.

)";

const char* mode_text =
    R"(## Accuracy settings

The paper's five models (torus, pawn, human, tooth and cylinder, 258 to 1,202 vertices each) bend, twist and turn while
they come together until they interpenetrate, and part again; all ten pairs are listed in every frame.

| column | meaning |
| :-- | :-- |
| complete | pairs that no budget cut short |
| found | of the contacts of exact mode in the same detail, how many the setting reports |
| right | of the contacts that the setting reports, how many are truly below the contact distance |
| touching found | of the pairs of models in contact, how many the setting says are |
| width | upper − lower of the pairs' bounds |
| above truth, below truth | upper − true distance, and true distance − lower |
| broken bounds | pairs whose true distance is not between lower and upper |
| region pairs | how many pairs of regions a step tests, the measure of work that is the same on every machine |

Widths and errors of distances are in mean edge lengths. `within` leaves the distances of pairs in contact exact. A budget is
for each step; budgets are parts of what exact mode takes on average, and frames where the models interpenetrate take more.
A pair that a budget cuts short has looser bounds, at worst those of the two models' boxes.
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
  return "### Pairs and decisions\n\nA pair is asked for its surfaces' distance and for its vertices'. Its "
         "bounds are "
         "wrong where they are not the true distance rounded down and up. How the questions of all details "
         "were "
         "settled: pairs of features or vertices of two leaves that float arithmetic discarded as too far; "
         "contacts that it named; questions "
         "that double arithmetic decided; and those that it left open, which exact arithmetic decided. On "
         "degenerate "
         "input many are ties, which no rounded arithmetic can decide. These counts are of tiny meshes made "
         "to be "
         "hard: a step's statistics have those of a real scene.\n\n" +
         decision_table(results);
}

std::string detail_title(ContactDetail detail) {
  switch (detail) {
    case ContactDetail::none:
      return "### Distances of surfaces (`none`)\n\nNo contacts are asked for, so that none can be "
             "missing.\n\n";
    case ContactDetail::features:
      return "### Contacts of surfaces (`features`)\n\n";
    case ContactDetail::regions:
      return "### Contacts of regions (`regions`)\n\nDistances are between vertices. *Found* compares names: "
             "the "
             "paper's DV walks on from the closest vertices of two leaves to nearer neighbours, so that "
             "several "
             "pairs of leaves end at one contact, and what it ends at may be another leaf's. *Touching "
             "found* and "
             "*right* are not affected by that.\n\n";
    default:
      return "### Contacts of vertices (`vertices`)\n\nDistances are between vertices. What is missing here "
             "the "
             "paper's test of middle vertices (eq. 4) has cut off.\n\n";
  }
}

std::string mode_sections(const AccuracyResults& results) {
  std::string text = mode_text;
  text += format("There are %u frames, the mean edge length at rest is %.4f, and the contact distance %.4f. ",
                 results.frames, results.edge_length, results.contact_distance);
  text += "The numbers of the paper's test are parts of the most that eq. 6 gives for these models at rest:";
  for (std::size_t level = 1; level < results.level_epsilon.size(); ++level)
    text += format("%s %.4f", level == 1 ? "" : ",", results.level_epsilon[level]);
  text += " for levels 1 and deeper; the last number, DV's, is the contact distance or a multiple of it.\n\n";
  text += format(
      "The truth is exact mode. That exact mode is right here was checked with the oracle for %llu of "
      "the %llu pairs in all frames: the bounds between surfaces and between vertices to the last bit, and "
      "%llu "
      "contacts of `features`, `regions` and `vertices` by name; %llu were wrong.\n\n",
      number(results.truth.checked), number(results.truth.pair_rows), number(results.truth.contacts),
      number(results.truth.wrong));
  for (const ModeTable& table : results.modes)
    text += detail_title(table.detail) + mode_table(table.results, results.frames);
  return text;
}

std::string time_section(const AccuracyResults& results, const std::string& figure) {
  std::string text =
      "## Time\n\nTimes are those of the machine that wrote this page, of an optimised build and one "
      "thread: the mean over the frames, of each frame the fastest of ";
  text += format(
      "%u runs. The rest of this page is the same for the same seed on every machine; this section is "
      "not, and the answers under time budgets are not either.\n\n",
      results.runs);
  text += "![time against error](" + figure +
          ")\n\nLeft: how wide the bounds of distances are on average; exact mode's are neighbouring "
          "doubles. Right: the share of contacts that is missing. Paper settings are those of the detail "
          "`vertices`.\n\n";
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
