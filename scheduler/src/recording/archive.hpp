#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <graze/accuracy.hpp>
#include <graze/error.hpp>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <graze/scene_enumerators.hpp>
#include <graze/settings.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "recording/byte_buffer.hpp"

namespace graze {

/// A value that stands in a recording as its own bytes, in little-endian order.
template <typename Value>
concept PlainValue = std::is_arithmetic_v<Value> || std::is_enum_v<Value>;

template <typename Enum>
constexpr std::underlying_type_t<Enum> underlying(Enum value) {
  return static_cast<std::underlying_type_t<Enum>>(value);
}
/// The last value of each enumeration that a recording has. Others are refused when they are read.
template <typename Enum>
inline constexpr std::underlying_type_t<Enum> last_of =
    std::numeric_limits<std::underlying_type_t<Enum>>::max();
template <NamedEnumeration Enum>
inline constexpr std::underlying_type_t<Enum> last_of<Enum> = underlying(enumerators<Enum>.back());

/// The fewest bytes that a value takes in a recording, or fewer.
template <typename Value>
constexpr std::size_t least_size_of() {
  if constexpr (PlainValue<Value>) {
    return sizeof(Value);
  } else if constexpr (requires(Value & value) { fields(value); }) {
    constexpr auto sum = []<typename... Fields>(const std::tuple<Fields&...>*) {
      return (least_size_of<Fields>() + ... + std::size_t{0});
    };
    return sum(static_cast<decltype(fields(std::declval<Value&>()))*>(nullptr));
  } else {
    return 1;
  }
}

/// The bytes of positions start at a multiple of this in their chunk, so that they can be viewed in place.
inline constexpr std::size_t position_alignment = 8;

/// The bytes from a place to the next one where positions may begin.
constexpr std::size_t padding_at(std::size_t place) {
  return (position_alignment - place % position_alignment) % position_alignment;
}

/// Turns the bytes of each number round where the machine is big-endian.
inline void to_little_endian(std::span<std::byte> bytes, std::size_t number_size) {
  if constexpr (std::endian::native == std::endian::big)
    for (std::size_t begin = 0; begin < bytes.size(); begin += number_size)
      std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                   bytes.begin() + static_cast<std::ptrdiff_t>(begin + number_size));
}

/// Pads a buffer with zeros up to a place where positions may begin.
inline void align(ByteBuffer& buffer) {
  for (std::byte& byte : buffer.grow(padding_at(buffer.size()))) byte = std::byte{0};
}

/// Writes fields at the end of a buffer.
class ByteSink {
 public:
  explicit ByteSink(ByteBuffer& buffer) : buffer_(buffer) {}

  template <typename... Fields>
  void operator()(const Fields&... fields) {
    (write(fields), ...);
  }

 private:
  template <PlainValue Value>
  void write(const Value& value) {
    const std::span<std::byte> added = buffer_.grow(sizeof(Value));
    std::memcpy(added.data(), &value, sizeof(Value));
    to_little_endian(added, sizeof(Value));
  }
  void write(const std::string& text) {
    write(std::uint64_t{text.size()});
    buffer_.append(std::as_bytes(std::span(text)));
  }
  template <typename Element>
  void write(const std::vector<Element>& elements) {
    write(std::uint64_t{elements.size()});
    for (const Element& element : elements) write(element);
  }
  template <typename Element, std::size_t count>
  void write(const std::array<Element, count>& elements) {
    for (const Element& element : elements) write(element);
  }
  template <typename Value>
  void write(const std::optional<Value>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  void write(const std::chrono::microseconds& time) { write(std::int64_t{time.count()}); }
  void write(const ObjectId& id) { (*this)(id.index, id.generation); }
  void write(const Accuracy& accuracy) { (*this)(accuracy.mode(), accuracy.tolerance(), accuracy.epsilon()); }
  void write(const PositionView& positions);
  template <typename Record>
  requires requires(const Record& record) { fields(record); }
  void write(const Record& record) {
    std::apply([this](const auto&... field) { (*this)(field...); }, fields(record));
  }

  ByteBuffer& buffer_;
};

/// Writes values at the end of a buffer.
template <typename... Fields>
void write_fields(ByteBuffer& buffer, const Fields&... values) {
  ByteSink sink(buffer);
  sink(values...);
}

/// Reads fields that ByteSink wrote. Throws Error where the bytes end too early or are no value of a field.
class ByteSource {
 public:
  /// `bytes` begin at a multiple of `position_alignment`, and stay as long as the positions that are read.
  explicit ByteSource(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <typename... Fields>
  void operator()(Fields&... fields) {
    (read(fields), ...);
  }
  [[nodiscard]] std::size_t at() const { return at_; }
  /// Goes on to a place where positions may begin.
  void align() { (void)take(padding_at(at_)); }
  [[nodiscard]] std::span<const std::byte> take(std::size_t count) {
    if (count > bytes_.size() - at_) throw Error("the data end too early");
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }

 private:
  template <PlainValue Value>
  void read(Value& value) {
    std::array<std::byte, sizeof(Value)> copy;
    std::memcpy(copy.data(), take(sizeof(Value)).data(), sizeof(Value));
    to_little_endian(copy, sizeof(Value));
    if constexpr (std::same_as<Value, bool>) {
      if (copy[0] > std::byte{1}) throw Error("a truth value is neither 0 nor 1");
      value = copy[0] == std::byte{1};
    } else {
      std::memcpy(&value, copy.data(), sizeof(Value));
    }
    if constexpr (std::is_enum_v<Value>)
      if (underlying(value) > last_of<Value>) throw Error("a value is no enumerator that is known");
  }
  /// A count of things that take `least_size` bytes each, so that no count asks for more memory than there
  /// are bytes.
  std::size_t read_count(std::size_t least_size) {
    std::uint64_t count = 0;
    read(count);
    if (count > (bytes_.size() - at_) / least_size) throw Error("a count is beyond the end of the data");
    return static_cast<std::size_t>(count);
  }
  void read(std::string& text) {
    const std::span<const std::byte> bytes = take(read_count(1));
    text.resize(bytes.size());
    if (!bytes.empty()) std::memcpy(text.data(), bytes.data(), bytes.size());
  }
  template <typename Element>
  void read(std::vector<Element>& elements) {
    elements.resize(read_count(least_size_of<Element>()));
    for (Element& element : elements) read(element);
  }
  template <typename Element, std::size_t count>
  void read(std::array<Element, count>& elements) {
    for (Element& element : elements) read(element);
  }
  template <typename Value>
  void read(std::optional<Value>& value) {
    bool has_value = false;
    read(has_value);
    value.reset();
    if (has_value) read(value.emplace());
  }
  void read(std::chrono::microseconds& time) {
    std::int64_t count = 0;
    read(count);
    time = std::chrono::microseconds(count);
  }
  void read(ObjectId& id) { (*this)(id.index, id.generation); }
  void read(Accuracy& accuracy);
  void read(PositionView& positions);
  template <typename Record>
  requires requires(Record& record) { fields(record); }
  void read(Record& record) {
    std::apply([this](auto&... field) { (*this)(field...); }, fields(record));
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace graze
