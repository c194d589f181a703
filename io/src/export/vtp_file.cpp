#include "export/vtp_file.hpp"

#include "export/base64.hpp"
#include "export/output_file.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {

std::int32_t VtpFile::add_point(const Eigen::Vector3d& point) {
  coordinates_.insert(coordinates_.end(), point.data(), point.data() + 3);
  return static_cast<std::int32_t>(coordinates_.size() / 3 - 1);
}

std::string VtpFile::binary_array(std::string_view type, std::string_view name, std::string_view bytes,
                                  int components) {
  // The number of bytes comes first, in the same base64 text.
  const std::uint64_t size = bytes.size();
  std::string content(reinterpret_cast<const char*>(&size), sizeof size);
  content += bytes;
  return joined("<DataArray type=\"", type, "\" Name=\"", name, "\" NumberOfComponents=\"", components,
                "\" format=\"binary\">", base64_encoded(content), "</DataArray>\n");
}

/// All four kinds of cells are named, since some readers want them. Those of another kind than the file's are
/// empty.
std::string VtpFile::cell_element(VtpCells kind, std::string_view element) const {
  static const std::vector<std::int32_t> none;
  const bool is_used = kind == kind_;
  return joined("<", element, ">\n", data_array("connectivity", is_used ? corners_ : none, 1),
                data_array("offsets", is_used ? ends_ : none, 1), "</", element, ">\n");
}

void VtpFile::write(const std::filesystem::path& path) const {
  const auto count_of = [&](VtpCells kind) { return kind == kind_ ? ends_.size() : 0; };
  OutputFile file(path);
  file.write(
      joined("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
             "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"",
             coordinates_.size() / 3, "\" NumberOfVerts=\"", count_of(VtpCells::vertices),
             "\" NumberOfLines=\"", count_of(VtpCells::lines), "\" NumberOfStrips=\"0\" NumberOfPolys=\"",
             count_of(VtpCells::polygons), "\">\n"));
  file.write(joined("<PointData>\n", point_data_, "</PointData>\n<CellData>\n", cell_data_, "</CellData>\n"));
  file.write(joined("<Points>\n", data_array("Points", coordinates_, 3), "</Points>\n"));
  file.write(cell_element(VtpCells::vertices, "Verts"));
  file.write(cell_element(VtpCells::lines, "Lines"));
  file.write(cell_element(VtpCells::polygons, "Polys"));
  file.write("</Piece>\n</PolyData>\n</VTKFile>\n");
  file.close();
}

}  // namespace graze::io
