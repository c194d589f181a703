#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <graze/error.hpp>
#include <graze/number_tuple.hpp>
#include <memory>
#include <ranges>
#include <string>
#include <type_traits>

namespace graze {

/// @cond internal
/// Returns a number as a double. A conversion of the processor would make 0 of a denormal float where the
/// caller flushes denormals, so their bits are converted as an integer.
template <typename Number>
[[nodiscard]] double exactly_as_double(Number number) {
  if constexpr (std::same_as<Number, float>) {
    const auto bits = std::bit_cast<std::uint32_t>(number);
    if ((bits & 0x7F800000U) == 0) {
      const double size = static_cast<double>(static_cast<std::int32_t>(bits & 0x7FFFFFU)) * 0x1p-149;
      return bits >> 31U == 0 ? size : -size;
    }
  }
  return static_cast<double>(number);
}
/// @endcond

/// @addtogroup positions
/// @{

/// A point type whose memory is three floats or three doubles and nothing else. `Eigen::Vector3f`,
/// `Eigen::Vector3d`, `std::array` and a caller's own struct of three such numbers are point types.
template <typename Point>
concept PackedPoint = TupleOf<Point, float, 3> || TupleOf<Point, double, 3>;

/// The type of a member of a caller's struct at which a position begins. The member is the x coordinate, an
/// array of three numbers, or a PackedPoint.
template <typename Member>
concept PositionMember = PackedPoint<Member> || std::same_as<Member, float> || std::same_as<Member, double> ||
    std::same_as<Member, float[3]> || std::same_as<Member, double[3]>;

/// A matrix of Eigen whose entries lie in memory as floats or doubles.
template <typename Matrix>
concept MatrixInMemory =
    std::derived_from<Matrix, Eigen::DenseBase<Matrix>> &&
        (int(Matrix::Flags) & Eigen::DirectAccessBit) != 0 &&
    PositionMember<typename Matrix::Scalar>&& std::floating_point<typename Matrix::Scalar>;

/// A matrix of Eigen that may hold points. By its type it has three rows, three columns, or any number of
/// columns.
template <typename Matrix>
concept PositionMatrix = MatrixInMemory<Matrix> &&
    (int(Matrix::ColsAtCompileTime) == 3 || int(Matrix::RowsAtCompileTime) == 3 ||
     int(Matrix::ColsAtCompileTime) == Eigen::Dynamic);

/// @cond internal
/// A temporary that owns the memory of its points, such as a vector that a function returns.
template <typename Points>
concept TemporaryPoints =
    !std::is_lvalue_reference_v<Points> &&
    ((std::ranges::range<Points> && !std::ranges::borrowed_range<Points>) ||
     std::derived_from<std::remove_cv_t<Points>, Eigen::PlainObjectBase<std::remove_cv_t<Points>>>);
/// @endcond

/// Describes positions in the caller's memory: size() points of three floats or three doubles. A view copies
/// nothing and owns nothing, so the memory must stay valid as long as the view is used.
///
/// The x of each point is stride_bytes() after the x of the point before. Its y is coordinate_stride_bytes()
/// after its x, and its z is as far after its y. Points whose three numbers follow each other without gaps
/// are read fastest.
class PositionView {
 public:
  /// Makes a view of no points.
  PositionView() = default;

  /// Makes a view of `count` points of floats. `first` points at the x of the first point. By default y and z
  /// follow x without a gap, and so does the next point. A null pointer or a wrong stride is a Diagnostic
  /// when a scene gets the view.
  PositionView(const float* first, std::size_t count, std::size_t stride_bytes = 3 * sizeof(float),
               std::size_t coordinate_stride_bytes = sizeof(float))
      : PositionView(first, count, stride_bytes, coordinate_stride_bytes, sizeof(float)) {}
  /// Makes a view of `count` points of doubles. `first` points at the x of the first point. By default y and
  /// z follow x without a gap, and so does the next point.
  PositionView(const double* first, std::size_t count, std::size_t stride_bytes = 3 * sizeof(double),
               std::size_t coordinate_stride_bytes = sizeof(double))
      : PositionView(first, count, stride_bytes, coordinate_stride_bytes, sizeof(double)) {}

  /// Makes a view of a vector, array or span of points. A point is an `Eigen::Vector3f`, an
  /// `Eigen::Vector3d`, a `std::array<float, 3>`, a `std::array<double, 3>`, or a caller's own struct of
  /// three floats or three doubles.
  template <std::ranges::contiguous_range Points>
  requires std::ranges::sized_range<Points> && PackedPoint<std::ranges::range_value_t<Points>> PositionView(
      const Points& points)  // NOLINT(google-explicit-constructor): a range of points is its view
      : PositionView(
            std::ranges::data(points), std::ranges::size(points), sizeof(std::ranges::range_value_t<Points>),
            sizeof(std::ranges::range_value_t<Points>) / 3, sizeof(std::ranges::range_value_t<Points>) / 3) {}

  /// Makes a view of a vector, array or span of the caller's own structs. The position of each begins at the
  /// member `position`. That member holds all three coordinates, or it is x, and y and z follow without a
  /// gap.
  ///
  ///     struct Vertex { float u, v, x, y, z; };
  ///     PositionView(vertices, &Vertex::x)
  ///
  /// Throws Error if y and z would lie outside the struct.
  template <std::ranges::contiguous_range Structs, typename Owner, PositionMember Member>
  requires std::ranges::sized_range<Structs> && std::derived_from<std::ranges::range_value_t<Structs>, Owner>
  PositionView(const Structs& structs, Member Owner::*position)
      : PositionView(position_in(structs, position), std::ranges::size(structs),
                     sizeof(std::ranges::range_value_t<Structs>), sizeof(NumberOf<Member>),
                     sizeof(NumberOf<Member>)) {}

  /// Makes a view of a matrix of Eigen with a point in each row, such as libigl's `Eigen::MatrixXd V`. It may
  /// be stored by columns or by rows, and may be a `Map`, `Ref` or `Block`. A type with exactly three rows
  /// and another number of columns, such as `Eigen::Matrix3Xd`, has a point in each column.
  ///
  /// The matrix must not be resized as long as the view is used. Throws Error if a matrix of any number of
  /// columns has not three of them.
  template <PositionMatrix Matrix>
  PositionView(const Matrix& matrix)  // NOLINT(google-explicit-constructor): a matrix of points is its view
      : PositionView(
            matrix.data(),
            static_cast<std::size_t>(has_points_in_rows<Matrix> ? rows_of_three(matrix) : matrix.cols()),
            bytes<Matrix>(has_points_in_rows<Matrix> ? matrix.rowStride() : matrix.colStride()),
            bytes<Matrix>(has_points_in_rows<Matrix> ? matrix.colStride() : matrix.rowStride()),
            sizeof(typename Matrix::Scalar)) {}

  /// Returns the address of the x of the first point.
  [[nodiscard]] const void* data() const { return first_; }
  /// Returns the number of points.
  [[nodiscard]] std::size_t size() const { return count_; }
  /// Returns the bytes from the x of a point to the x of the next one.
  [[nodiscard]] std::size_t stride_bytes() const { return stride_bytes_; }
  /// Returns the bytes from the x of a point to its y, and from its y to its z.
  [[nodiscard]] std::size_t coordinate_stride_bytes() const { return coordinate_stride_bytes_; }
  /// Returns true for doubles, and false for floats.
  [[nodiscard]] bool is_double() const { return form_ == Form::doubles || form_ == Form::doubles_apart; }
  /// Returns whether y follows x without a gap, and z follows y.
  [[nodiscard]] bool has_joined_coordinates() const {
    return form_ == Form::doubles || form_ == Form::floats;
  }

  /// Returns point `index` in double. A float converts exactly. There is no bounds check.
  [[nodiscard]] Eigen::Vector3d operator[](std::size_t index) const {
    const auto* const point = static_cast<const std::byte*>(first_) + index * stride_bytes_;
    if (form_ == Form::doubles) {
      std::array<double, 3> xyz;
      std::memcpy(xyz.data(), point, sizeof xyz);
      return {xyz[0], xyz[1], xyz[2]};
    }
    if (form_ == Form::floats) {
      std::array<float, 3> xyz;
      std::memcpy(xyz.data(), point, sizeof xyz);
      return {exactly_as_double(xyz[0]), exactly_as_double(xyz[1]), exactly_as_double(xyz[2])};
    }
    return form_ == Form::doubles_apart ? apart<double>(point) : apart<float>(point);
  }

 private:
  /// Says which numbers the memory holds, and whether the coordinates of a point lie apart.
  enum class Form : std::uint8_t { doubles, floats, doubles_apart, floats_apart };

  template <typename Member>
  using NumberOf = std::conditional_t<std::same_as<Member, double> || std::same_as<Member, double[3]> ||
                                          TupleOf<Member, double, 3>,
                                      double, float>;
  template <typename Matrix>
  static constexpr bool has_points_in_rows = int(Matrix::ColsAtCompileTime) == 3 ||
                                             int(Matrix::RowsAtCompileTime) != 3;

  PositionView(const void* first, std::size_t count, std::size_t stride_bytes,
               std::size_t coordinate_stride_bytes, std::size_t number_bytes)
      : first_(first),
        count_(count),
        stride_bytes_(stride_bytes),
        coordinate_stride_bytes_(coordinate_stride_bytes) {
    const bool joined = coordinate_stride_bytes == number_bytes;
    if (number_bytes == sizeof(double))
      form_ = joined ? Form::doubles : Form::doubles_apart;
    else
      form_ = joined ? Form::floats : Form::floats_apart;
  }

  template <typename Structs, typename Owner, typename Member>
  static const void* position_in(const Structs& structs, Member Owner::*position) {
    if (std::ranges::empty(structs)) return nullptr;
    const auto& first = *std::ranges::data(structs);
    const auto* const found = reinterpret_cast<const std::byte*>(std::addressof(first.*position));
    const std::byte* const end = reinterpret_cast<const std::byte*>(std::addressof(first)) + sizeof first;
    if (end - found < static_cast<std::ptrdiff_t>(3 * sizeof(NumberOf<Member>)))
      throw_error("positions: a member that is x has no y and z after it in its struct of " +
                  std::to_string(sizeof first) + " bytes");
    return found;
  }
  template <typename Matrix>
  static Eigen::Index rows_of_three(const Matrix& matrix) {
    if (matrix.cols() != 3)
      throw_error("positions: a matrix of " + std::to_string(matrix.rows()) + " rows and " +
                  std::to_string(matrix.cols()) + " columns; give a point in each row, in 3 columns");
    return matrix.rows();
  }
  template <typename Matrix>
  static std::size_t bytes(Eigen::Index numbers) {
    return static_cast<std::size_t>(numbers) * sizeof(typename Matrix::Scalar);
  }
  template <typename Number>
  [[nodiscard]] Eigen::Vector3d apart(const std::byte* point) const {
    std::array<Number, 3> xyz;
    for (Number& coordinate : xyz) {
      std::memcpy(&coordinate, point, sizeof coordinate);
      point += coordinate_stride_bytes_;
    }
    return {exactly_as_double(xyz[0]), exactly_as_double(xyz[1]), exactly_as_double(xyz[2])};
  }

  const void* first_ = nullptr;
  std::size_t count_ = 0;
  std::size_t stride_bytes_ = 0;
  std::size_t coordinate_stride_bytes_ = sizeof(double);
  Form form_ = Form::doubles;
};

/// @}

}  // namespace graze
