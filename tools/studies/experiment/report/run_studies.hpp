#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "experiment/options.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// A study that can be asked for.
struct StudyMaker {
  std::string name;  ///< of what it measures, for the line on a terminal
  std::function<Study(const ExperimentOptions&)> make;
};

/// Makes studies one after the other, and writes into `options.out`: the tables and figures as CSV, and
/// experiments.html, with the figures as SVG in figures/. With a folder `docs` also experiments.md there,
/// with PNGs in experiments/. Without gnuplot figures are left out, but for their CSV. Without
/// `options.times` everything timed is left out.
///
/// Throws CheckFailed, once all is written, where something that has to hold does not. Throws io::InputError
/// for what cannot be read or written.
void run_studies(std::span<const StudyMaker> makers, const ExperimentOptions& options,
                 const std::filesystem::path& docs);

}  // namespace graze::tools
