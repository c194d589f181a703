#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace graze::io {

/// The cells that a `.vtp` file has.
enum class VtpCells : std::uint8_t { vertices, lines, polygons };

/// Collects points and cells with their data, and writes them as VTK's PolyData in XML. Numbers are binary,
/// in base64.
class VtpFile {
 public:
  explicit VtpFile(VtpCells kind) : kind_(kind) {}

  /// Adds a point and returns its index.
  std::int32_t add_point(const Eigen::Vector3d& point);
  /// Adds a corner to the cell that end_cell() ends.
  void add_corner(std::int32_t point) { corners_.push_back(point); }
  void end_cell() { ends_.push_back(static_cast<std::int32_t>(corners_.size())); }

  /// Data of all points, `components` numbers for each.
  template <typename Number>
  void set_point_data(std::string_view name, const std::vector<Number>& numbers, int components = 1) {
    point_data_ += data_array(name, numbers, components);
  }
  /// Data of all cells, a number for each.
  template <typename Number>
  void set_cell_data(std::string_view name, const std::vector<Number>& numbers) {
    cell_data_ += data_array(name, numbers, 1);
  }
  void write(const std::filesystem::path& path) const;

 private:
  template <typename Number>
  static std::string data_array(std::string_view name, const std::vector<Number>& numbers, int components);
  static std::string binary_array(std::string_view type, std::string_view name, std::string_view bytes,
                                  int components);
  [[nodiscard]] std::string cell_element(VtpCells kind, std::string_view element) const;

  VtpCells kind_;
  std::vector<double> coordinates_;
  std::vector<std::int32_t> corners_;
  std::vector<std::int32_t> ends_;  ///< the corner behind the last one of each cell
  std::string point_data_;
  std::string cell_data_;
};

template <typename Number>
std::string VtpFile::data_array(std::string_view name, const std::vector<Number>& numbers, int components) {
  const std::string kind = std::is_floating_point_v<Number> ? "Float"
                           : std::is_signed_v<Number>       ? "Int"
                                                            : "UInt";
  return binary_array(kind + std::to_string(8 * sizeof(Number)), name,
                      {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)},
                      components);
}

}  // namespace graze::io
