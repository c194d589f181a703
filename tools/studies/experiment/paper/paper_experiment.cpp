#include "experiment/paper/paper_experiment.hpp"

#include <iterator>
#include <string>
#include <utility>

#include "experiment/paper/motion/human_parts.hpp"
#include "experiment/paper/motion/motion_files.hpp"
#include "experiment/paper/motion/paper_motions.hpp"
#include "experiment/paper/paper_measures.hpp"
#include "experiment/paper/paper_rows.hpp"
#include "experiment/paper/text/paper_claims.hpp"
#include "experiment/paper/text/paper_figures.hpp"
#include "experiment/paper/text/paper_tables.hpp"
#include "experiment/paper/text/paper_text.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

const char* title_of(int number) {
  if (number == 1) return "Experiment 1: ten objects, tori and pawns";
  if (number == 2) return "Experiment 2: three humans and a torus";
  return "Experiment 3: a rigid tooth and a deforming cylinder";
}

template <typename Item>
void append(std::vector<Item>&& from, std::vector<Item>& to) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

void add_results(const RecordedMotion& motion, const PaperResults& results, const std::string& prefix,
                 const std::string& of, Study& study) {
  append(tables_of(motion, results, prefix, of), study.tables);
  append(figures_of(results, prefix, of), study.figures);
  study.violations.insert(study.violations.end(), results.violations.begin(), results.violations.end());
}

/// Paper mode gives DV all pairs of leaves of level 1, which small parts end at, in every step: it takes
/// long.
constexpr std::size_t one_step_in = 4;

/// Experiment 2 once more, its humans in parts.
void add_parts(const RecordedMotion& motion, const std::vector<PaperRow>& rows, const PaperResults& whole,
               const ExperimentOptions& options, Study& study) {
  const RecordedMotion in_parts = with_humans_in_parts(motion, one_step_in);
  write_motion(options.out / in_parts.name, in_parts, rows);
  const PaperResults results = measure_paper(in_parts, rows, options, Extent::one_reading);
  study.claims.push_back(parts_claim(whole, results));
  add_results(in_parts, results, "parts_", "; humans in parts", study);
}

}  // namespace

Study paper_experiment(int number, const ExperimentOptions& options) {
  const RecordedMotion motion = record_experiment(number, options);
  const std::vector<PaperRow> rows = paper_rows(number);
  write_motion(options.out / motion.name, motion, rows);
  const PaperResults results = measure_paper(motion, rows, options, Extent::all_readings);
  Study study;
  study.name = motion.name;
  study.title = title_of(number);
  study.text = text_of(number, motion, results);
  study.claims = claims_of(number, results);
  add_results(motion, results, "", "", study);
  if (number == 2) add_parts(motion, rows, results, options, study);
  return study;
}

}  // namespace graze::tools
