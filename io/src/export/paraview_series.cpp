#include <graze/io/paraview_series.hpp>

#include "export/output_file.hpp"
#include "export/vtp_parts.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

/// The parts of a frame. Each is a file of its own.
constexpr std::array<std::string_view, 3> vtp_parts{"surfaces", "contacts", "lines"};

/// The name of a part's file, such as `surfaces_000012.vtp`. The digits keep the files of a folder in order.
std::string vtp_name(std::string_view part, std::uint64_t frame) {
  const std::string digits = std::to_string(frame);
  constexpr std::size_t width = 6;
  return joined(part, "_", std::string(width - std::min(width, digits.size()), '0'), digits, ".vtp");
}

/// A text in which characters that mean something in XML are spelled out.
std::string xml_text(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '&')
      escaped += "&amp;";
    else if (letter == '<')
      escaped += "&lt;";
    else if (letter == '"')
      escaped += "&quot;";
    else
      escaped += letter;
  }
  return escaped;
}

}  // namespace

ParaviewSeries::ParaviewSeries(const std::filesystem::path& pvd)
    : pvd_(pvd), folder_(pvd.parent_path() / pvd.stem()) {
  if (pvd_.stem() == pvd_.filename()) fail(pvd_, "the name of a time series needs an ending; end it in .pvd");
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) fail(folder_, "the folder cannot be made (" + error.message() + "); name another file");
}

void ParaviewSeries::write(const SceneSnapshot& snapshot) {
  const auto path = [&](std::size_t part) { return folder_ / vtp_name(vtp_parts[part], snapshot.frame); };
  write_vtp_surfaces(path(0), snapshot);
  write_vtp_contacts(path(1), snapshot);
  write_vtp_lines(path(2), snapshot);
  frames_.push_back(snapshot.frame);
}

void ParaviewSeries::close() const {
  OutputFile file(pvd_);
  file.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n");
  const std::string folder = xml_text(folder_.filename().string());
  for (const std::uint64_t frame : frames_)
    for (std::size_t part = 0; part < vtp_parts.size(); ++part)
      file.write(joined("<DataSet timestep=\"", frame, "\" part=\"", part, "\" file=\"", folder, "/",
                        vtp_name(vtp_parts[part], frame), "\"/>\n"));
  file.write("</Collection>\n</VTKFile>\n");
  file.close();
}

std::size_t ParaviewSeries::frame_count() const {
  return frames_.size();
}

}  // namespace graze::io
