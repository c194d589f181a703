#include "recording/archive.hpp"

namespace graze {
namespace {

/// How positions stand in a recording.
enum class PositionForm : std::uint8_t { none, floats, doubles };

std::size_t bytes_of_point(PositionForm form) {
  return form == PositionForm::doubles ? 3 * sizeof(double) : 3 * sizeof(float);
}

/// Copies strided coordinates into packed ones.
void pack(const PositionView& positions, std::span<std::byte> packed) {
  const std::size_t number = positions.is_double() ? sizeof(double) : sizeof(float);
  const auto* const first = static_cast<const std::byte*>(positions.data());
  if (positions.has_joined_coordinates() && positions.stride_bytes() == 3 * number) {
    if (!packed.empty()) std::memcpy(packed.data(), first, packed.size());
    return;
  }
  std::byte* to = packed.data();
  for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
    for (std::size_t axis = 0; axis < 3; ++axis, to += number)
      std::memcpy(to, first + vertex * positions.stride_bytes() + axis * positions.coordinate_stride_bytes(),
                  number);
}

}  // namespace

void ByteSink::write(const PositionView& positions) {
  const PositionForm form = positions.size() == 0   ? PositionForm::none
                            : positions.is_double() ? PositionForm::doubles
                                                    : PositionForm::floats;
  (*this)(form, std::uint64_t{positions.size()});
  align(buffer_);
  if (form == PositionForm::none) return;
  const std::span<std::byte> packed = buffer_.grow(positions.size() * bytes_of_point(form));
  pack(positions, packed);
  to_little_endian(packed, bytes_of_point(form) / 3);
}

void ByteSource::read(PositionView& positions) {
  PositionForm form{};
  std::uint64_t count = 0;
  (*this)(form, count);
  if (form > PositionForm::doubles || (form == PositionForm::none) != (count == 0))
    throw Error("positions have a form that is not known");
  align();
  positions = {};
  if (form == PositionForm::none) return;
  if (count > (bytes_.size() - at_) / bytes_of_point(form)) throw Error("positions end too early");
  const std::byte* const first = take(static_cast<std::size_t>(count) * bytes_of_point(form)).data();
  // The bytes stand in memory as numbers of that type: a recording is read on a machine of its own order.
  if (form == PositionForm::doubles)
    positions = PositionView(reinterpret_cast<const double*>(first), static_cast<std::size_t>(count));
  else
    positions = PositionView(reinterpret_cast<const float*>(first), static_cast<std::size_t>(count));
}

void ByteSource::read(Accuracy& accuracy) {
  AccuracyMode mode{};
  double tolerance = 0;
  std::vector<double> epsilon;
  (*this)(mode, tolerance, epsilon);
  switch (mode) {
    case AccuracyMode::exact:
      accuracy = Accuracy::exact();
      return;
    case AccuracyMode::within:
      accuracy = Accuracy::within(tolerance);
      return;
    case AccuracyMode::paper:
      accuracy = Accuracy::paper(epsilon);
      return;
  }
  throw Error("an accuracy is not known");
}

}  // namespace graze
