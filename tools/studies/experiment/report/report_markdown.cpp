#include "experiment/report/report_markdown.hpp"

#include <vector>

#include "output/text_table.hpp"

namespace graze::tools {
namespace {

const char* introduction =
    R"(# The paper's experiments, and speed against error

This page answers three questions by measurement:

- Does the paper's method find all collisions? Its three experiments are played beside the truth.
- Do other ways to divide a mesh work better? They are compared on the same scenes. Other bounds of regions were compared
  once: `docs/bounding_volumes.md` has the result.
- What does each accuracy mode of graze give for its time?

The paper is *A Distance Hierarchy to Detect Collisions Between Deformable Objects* (Madera, Day, Laycock). Its equations
(eq.), sections and table rows are cited by their numbers. `docs/method.md` describes its method in other words.

`graze_studies experiment all` measures everything anew and writes this page. `tools/experiments.sh` installs what is missing,
builds graze and runs that command. All steps run on one thread. Times are of the machine that wrote this page;
everything else is the same in a second run. The command also writes CSV files. They hold every table, also those too
long for this page, and the points of every figure.

A figure of times draws four of the settings. They are the paper's best row, the paper's formula, and exact mode with and
without all distances. Light points are single steps, and a line is their running median. The CSV has every setting.

<a id="terms"></a>

## Terms of the paper's experiments

- *DMV* is the paper's walk through pairs of regions, level by level, down to pairs of leaf regions.
- *DV* is what the paper does with two leaf regions: it walks from their closest vertices along the mesh to closer ones.
- *ε of a region* (eq. 2) is the largest distance from the region's middle vertex to one of its vertices.
- *ε of a level* (eq. 3) is the largest ε of the level's regions.
- Two regions *pass eq. 4* if their middle vertices are closer than ε.
- *ε summed by eq. 6* is the sum of both objects' ε, for a pair of objects.
- A *row* is one of the paper's table for the experiment: ε of level 1, of level 2, and the last ε. The paper finds row 3
  best.
- The *last ε* is the distance below which DV reports.
- A *collision* is a pair of leaf regions with a pair of vertices closer than the last ε.
- The *truth* is all collisions, from a test of every pair of leaf regions. double holds the squares of all distances
  exactly.
- *Found* are collisions whose leaf regions DMV reaches. *Missed* are all other collisions.
- *Reported by DV* are pairs of leaf regions where DV's walk ends below the last ε.
- *Reported, no collision* are reported pairs without vertices that near. DV's walk has led out of the two leaf regions.
- *Different vertex pairs* are those where DV's walks end, each counted once. Many walks end at one pair.
- *All distances* means that the setting asks how far every pair of objects is apart, however far.
- *Regions expanded* and *leaf pairs tested* are 0 for the detail `vertices`, which compares blocks of vertices and no
  regions.
- *Pairs of objects compared* are all pairs of every step that is played. For the detail `features` they are one in ten, or
  all where `--frames` is given.

The paper leaves two things open, so its numbers are read in three ways:

- *As in eq. 4*: ε of a pair of objects is one number, as in the paper's tables. `Accuracy::paper` reads a row like this.
  Leaf regions go to DV without a test, as in the paper's pseudocode.
- *Leaves tested, too*: ε is one number, and leaf regions must pass eq. 4 before DV.
- *Summed as in eq. 6*: each object has the number, and the pair has the sum. Leaf regions go to DV without a test.

What follows from this:

- At this scale only the summed reading can find everything. Spheres of radius ε about two middle vertices touch up to a
  distance of twice ε.
- A leaf has at most 30 vertices, and most of these meshes end at level 2. So ε of level 2 decides only where a region of
  level 2 still has children.
- If leaves are tested, DV gets far fewer pairs, closer to the paper's counts. More collisions are missed.

<a id="motion"></a>

## Motion of the paper's experiments

Deforming bodies are mass-spring systems, with springs along edges and bends across them. Implicit Euler moves them, in
the form of Liu and others (2013), which no step makes unstable. Bodies start with a spin and a stretch that the seed
decides, and go to one point. They push each other off where exact mode finds their surfaces near. If two came closer than
a quarter of a unit, all would stand still from there on.

The motion is made once, rounded to multiples of 2⁻¹⁴, and every setting plays the same one. The command writes it as scene
files that `graze run` plays.

)";

const char* pictures_of_viewer =
    R"(<a id="pictures"></a>

## The paper's figures 7 and 8

graze's viewer draws these figures anew. A line joins the middle vertices of two regions that pass eq. 4. Its colour is
their level: red for level 1, green for level 2, blue for level 3. The numbers below the picture count the lines.

| picture | ε of level 1, of level 2, and last ε | row |
| :-- | :-- | :-- |
| two pawns | 24, 14, 8 | row 3 of table 2 |
| three humans and a torus: between humans | 25, 15, 10 | row 3 of table 3 |
| three humans and a torus: between a human and the torus | 35, 30, 10 | row 3 of table 3 |

The two pawns are models of experiment 1, put near each other. The humans and the torus are those of experiment 2, played
in 40 steps instead of 200, in frame 14. One command makes both pictures anew, in about a minute. It needs Chromium, and a
graze that was built with the viewer:

    node docs/experiments/make_pictures.mjs build/release/tools/graze/graze

![Two pawns: red, green and blue lines join their heads and their feet](experiments/viewer_pawns.png)

![Three humans and a torus: red, green and blue lines join the torus and the heads of two of them](experiments/viewer_humans.png)

)";

/// The text as a sentence: with a full stop at its end.
std::string sentence_of(const std::string& text) {
  std::string shown = markdown_text(text);
  if (!shown.ends_with('.')) shown += '.';
  return shown;
}

std::string claims_of(const std::vector<Claim>& claims) {
  if (claims.empty()) return "";
  std::string text = "What the paper says, what was measured, and whether it holds:\n\n";
  for (const Claim& claim : claims)
    text += "- " + sentence_of(claim.said) + " **Measured:** " + sentence_of(claim.measured) +
            " **Holds:** " + sentence_of(claim.holds) + "\n";
  return text + "\n";
}

std::string section_of(const Study& study, const ImageOf& image_of) {
  std::string text =
      "<a id=\"" + study.name + "\"></a>\n\n## " + markdown_text(study.title) + "\n\n" + study.text;
  while (text.ends_with('\n')) text.pop_back();
  text += "\n\n" + claims_of(study.claims);
  for (const std::string& violation : study.violations) text += "**Does not hold:** " + violation + "\n\n";
  for (const Figure& figure : study.figures) {
    const std::string image = image_of(study, figure);
    if (!image.empty()) text += "![" + markdown_text(figure.title) + "](" + image + ")\n\n";
  }
  for (const ResultTable& table : study.tables)
    if (table.shown) text += markdown_of(table);
  return text;
}

}  // namespace

std::string markdown_of(std::span<const Study> studies, const ImageOf& image_of, Pictures pictures) {
  std::string text = introduction;
  if (pictures == Pictures::of_viewer_too) text += pictures_of_viewer;
  text += "## Studies\n\n";
  for (const Study& study : studies) text += "- [" + markdown_text(study.title) + "](#" + study.name + ")\n";
  text += "\n";
  for (const Study& study : studies) text += section_of(study, image_of);
  text.pop_back();  // one newline ends the file
  return text;
}

}  // namespace graze::tools
