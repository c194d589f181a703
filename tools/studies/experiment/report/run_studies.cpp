#include "experiment/report/run_studies.hpp"

#include <algorithm>
#include <cstdio>
#include <graze/io/error.hpp>
#include <vector>

#include "check_failed.hpp"
#include "experiment/report/report_markdown.hpp"
#include "figures/figure_plot.hpp"
#include "figures/html_page.hpp"
#include "output/text_file.hpp"
#include "progress.hpp"

namespace graze::tools {
namespace {

constexpr const char* page_title = "The paper's experiments, and speed against error";

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw io::InputError(folder.string() + ": cannot be made; name a folder that can be written to");
}

std::string file_name(const Study& study, const Figure& figure, const char* extension) {
  return study.name + "_" + figure.name + extension;
}

/// Removes tables and figures of times if times are not wanted, and figures without a point.
void leave_out(Study& study, bool times) {
  std::erase_if(study.tables, [&](const ResultTable& table) { return table.timed && !times; });
  std::erase_if(study.figures, [&](const Figure& figure) {
    const bool is_empty =
        std::ranges::all_of(figure.series, [](const Series& series) { return series.x.empty(); });
    return is_empty || (figure.timed && !times);
  });
}

/// The results of all studies, and the violations among them.
struct Findings {
  std::vector<Study> studies;
  std::vector<std::string> violations;
};

Findings make_all(std::span<const StudyMaker> makers, const ExperimentOptions& options) {
  Findings findings;
  for (const StudyMaker& maker : makers) {
    Progress progress(maker.name + ": study", makers.size());
    progress.at(static_cast<std::uint64_t>(&maker - makers.data()));
    try {
      Study study = maker.make(options);
      leave_out(study, options.times);
      findings.violations.insert(findings.violations.end(), study.violations.begin(), study.violations.end());
      findings.studies.push_back(std::move(study));
    } catch (const CheckFailed& failure) {
      findings.violations.emplace_back(failure.what());
    }
  }
  return findings;
}

void draw_all(std::span<const Study> studies, const std::filesystem::path& folder, const char* extension) {
  make_folder(folder);
  std::vector<Drawing> drawings;
  for (const Study& study : studies)
    for (const Figure& figure : study.figures)
      drawings.push_back({{&figure, 1}, folder / file_name(study, figure, extension)});
  draw(drawings);
}

/// Writes STUDY_TABLE.csv for each table, and STUDY_FIGURE.points.csv for each figure.
void write_csv(const std::filesystem::path& folder, std::span<const Study> studies) {
  for (const Study& study : studies) {
    for (const ResultTable& table : study.tables)
      write_text_file(folder / (study.name + "_" + table.name + ".csv"), csv_of(table));
    for (const Figure& figure : study.figures)
      write_text_file(folder / file_name(study, figure, ".points.csv"), csv_of(figure));
  }
}

void write_page(const std::filesystem::path& out, std::span<const Study> studies, bool with_figures) {
  const std::filesystem::path figures = out / "figures";
  if (with_figures) draw_all(studies, figures, ".svg");
  const std::string page = markdown_of(
      studies,
      [&](const Study& study, const Figure& figure) {
        if (!with_figures) return std::string();
        return data_address_of(read_text_file(figures / file_name(study, figure, ".svg")));
      },
      Pictures::of_studies);
  write_text_file(out / "experiments.html", html_of(page, page_title));
}

void write_document(const std::filesystem::path& docs, std::span<const Study> studies, bool with_figures) {
  if (with_figures) draw_all(studies, docs / "experiments", ".png");
  write_text_file(docs / "experiments.md", markdown_of(
                                               studies,
                                               [&](const Study& study, const Figure& figure) {
                                                 return with_figures ? "experiments/" +
                                                                           file_name(study, figure, ".png")
                                                                     : std::string();
                                               },
                                               Pictures::of_viewer_too));
}

}  // namespace

void run_studies(std::span<const StudyMaker> makers, const ExperimentOptions& options,
                 const std::filesystem::path& docs) {
  make_folder(options.out);
  if (!docs.empty()) make_folder(docs);
  const bool with_figures = has_gnuplot();
  if (!with_figures)
    std::fputs("note: gnuplot: not found, so that there are tables and CSV only; install gnuplot-nox\n",
               stderr);
  const Findings findings = make_all(makers, options);
  write_csv(options.out, findings.studies);
  write_page(options.out, findings.studies, with_figures);
  if (!docs.empty()) write_document(docs, findings.studies, with_figures);
  throw_violations(findings.violations);
}

}  // namespace graze::tools
