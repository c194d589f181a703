#include "experiment/speed/speed_against_error.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "experiment/speed/speed_figures.hpp"
#include "experiment/speed/speed_tables.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

const char* speed_introduction =
    R"(**What was measured.** Which accuracy mode gives what for its time? Every scene is asked two questions. Both are about
vertices, so that all modes can answer them.

- *Contacts* asks for every vertex pair closer than the contact distance.
- *Distances* asks the same, and how far each pair of objects is apart, however far.

Each mode is turned along its dial:

- Of `within(t)` it is the tolerance, in mean edge lengths and as loose as the regions of a level are (eq. 6). A step
  stops at a level where its bounds are tight enough.
- Of *paper, eq. 3 and 6* it is the numbers that these equations give in each step.
- Of *numbers × f* it is fixed parts of the most that eq. 3 and 6 give at rest.
- In *the last × 1.5*, DV's threshold is 1.5 times the contact distance, as if ε were chosen badly the other way. Figures
  call it *last number too large*.
- Of the *work budget* and the *time budget* it is parts of what exact mode takes. Work is counted in region pairs.

Terms and conditions:

- The *truth* is exact mode. Brute force over all pairs of vertices checks it in some of the frames.
- The *distance error* is how much further apart the two named vertices are than the closest ones.
- A *budget* goes to the pairs of objects in order of urgency. A pair whose turn does not come, or that is cut short, has
  no contacts. Its distance is the upper bound known by then.
- The *Pareto front* is the settings that no other beats: no other is both as fast and as right, and better in one.
- *The paper's scenes* are the last 25 frames of its experiments. All pairs have one contact distance, the last number of
  row 3.
- *Real scenes* are meshes whose parts wobble by half an edge length. Their contact distance is the mean edge length.
)";

/// The least and largest of a value over scenes.
struct Range {
  double least = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();

  void add(double value) {
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
};

template <typename ValueOf>
Range range_of(std::span<const SpeedResults> scenes, SpeedQuestion question, ModeFamily family,
               const ValueOf& value_of) {
  Range range;
  for (const SpeedResults& scene : scenes)
    for (const SpeedMeasure& measure : scene.measures)
      if (measure.question == question && measure.result.setting.family == family)
        range.add(value_of(measure));
  return range;
}

double recall(const SpeedMeasure& measure) {
  return measure.result.recall();
}
double relative_ms(const SpeedMeasure& measure) {
  return measure.relative_ms;
}

bool has_no_error(const SpeedMeasure& measure) {
  return measure.question == SpeedQuestion::contacts ? measure.contact_error() == 0
                                                     : measure.distance_error() == 0;
}

/// In how many scenes some setting of the paper's test answers as exact mode does and is faster.
std::size_t scenes_paper_wins(std::span<const SpeedResults> scenes, SpeedQuestion question) {
  return static_cast<std::size_t>(std::ranges::count_if(scenes, [&](const SpeedResults& scene) {
    return std::ranges::any_of(scene.measures, [&](const SpeedMeasure& measure) {
      const ModeFamily family = measure.result.setting.family;
      const bool is_paper = family == ModeFamily::paper_formula || family == ModeFamily::paper_numbers;
      return measure.question == question && is_paper && measure.relative_ms < 1 && has_no_error(measure);
    });
  }));
}

/// "97 % to 100 %", or one of them where they are the same.
std::string percent_text(const Range& range) {
  const std::string least = format("%.4g %%", 100 * range.least);
  const std::string largest = format("%.4g %%", 100 * range.largest);
  return least == largest ? least : least + " to " + largest;
}

std::string answers_text(std::span<const SpeedResults> scenes) {
  const Range formula = range_of(scenes, SpeedQuestion::contacts, ModeFamily::paper_formula, recall);
  const Range numbers = range_of(scenes, SpeedQuestion::contacts, ModeFamily::paper_numbers, recall);
  return "\n**Result.**\n\n| setting | contacts found |\n| :-- | :-- |\n| paper, eq. 3 and 6, from scene to "
         "scene | " +
         percent_text(formula) + " |\n| numbers × f, from setting to setting | " + percent_text(numbers) +
         " |\n| `within(t)`, at every tolerance | all, and no others |\n";
}

std::string times_text(std::span<const SpeedResults> scenes) {
  const Range formula = range_of(scenes, SpeedQuestion::contacts, ModeFamily::paper_formula, relative_ms);
  const Range loose = range_of(scenes, SpeedQuestion::distances, ModeFamily::within, relative_ms);
  return format(
      "\n| question | setting | time / exact mode's | scenes where some setting of the paper's test gives "
      "the same answers in less time |\n| :-- | :-- | :-- | :-- |\n"
      "| contacts | paper, eq. 3 and 6 | %.2f to %.2f | %zu of %zu |\n"
      "| distances | `within(t)`, by tolerance | %.2f to %.2f | %zu of %zu |\n",
      formula.least, formula.largest, scenes_paper_wins(scenes, SpeedQuestion::contacts), scenes.size(),
      loose.least, loose.largest, scenes_paper_wins(scenes, SpeedQuestion::distances), scenes.size());
}

Claim accuracy_claim(std::span<const SpeedResults> scenes) {
  const Range formula = range_of(scenes, SpeedQuestion::contacts, ModeFamily::paper_formula, recall);
  const Range numbers = range_of(scenes, SpeedQuestion::contacts, ModeFamily::paper_numbers, recall);
  const Range exact = range_of(scenes, SpeedQuestion::contacts, ModeFamily::exact, recall);
  return {"One drawback is the accuracy of the algorithm (conclusion)",
          "by its own eq. 3 and 6 it finds " + percent_text(formula) +
              " of the contacts in these frames, with fixed numbers " + percent_text(numbers) +
              ". Exact mode on the same hierarchy finds " + percent_text(exact),
          formula.least == 1 ? "yes, but not by eq. 3 and 6 in these frames" : "yes"};
}

void add_violations(const SpeedResults& scene, std::vector<std::string>& violations) {
  if (scene.truth.wrong > 0)
    violations.push_back(scene.title + ": exact mode is not what brute force over all vertices gives");
  for (const SpeedMeasure& measure : scene.measures) {
    const ModeResult& result = measure.result;
    const std::string name = scene.title + ", " + result.setting.name;
    const ModeFamily family = result.setting.family;
    const bool is_certain = family == ModeFamily::exact || family == ModeFamily::within;
    if (is_certain && measure.contact_error() > 0)
      violations.push_back(name + ": contacts are not all, or too many");
    if (result.broken_bounds > 0) violations.push_back(name + ": distances outside their bounds");
  }
}

}  // namespace

Study speed_against_error_study(const ExperimentOptions& options) {
  std::vector<SpeedResults> scenes;
  for (SpeedScene& scene : speed_scenes(options)) scenes.push_back(measure_speed(std::move(scene), options));
  Study study{
      "speed", "Speed against error", speed_introduction, speed_tables(scenes), speed_figures(scenes), {},
      {}};
  study.text += answers_text(scenes);
  if (options.times) study.text += times_text(scenes);
  study.claims.push_back(accuracy_claim(scenes));
  for (const SpeedResults& scene : scenes) add_violations(scene, study.violations);
  return study;
}

}  // namespace graze::tools
