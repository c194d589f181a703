#include "pair_case.hpp"

#include <cmath>
#include <graze/enumerators.hpp>
#include <limits>

namespace graze::fuzz {
namespace {

constexpr std::uint32_t most_vertices = 24;
constexpr std::uint32_t most_faces = 12;

enum class Numbers : std::uint8_t { coarse, fine, any };
constexpr double coarse_step = 0.25;
constexpr double fine_step = 0x1p-10;
constexpr int coarse_nan = -128;

double number(ByteReader& reader, Numbers numbers) {
  if (numbers == Numbers::any) return reader.raw<double>();
  if (numbers == Numbers::fine) return fine_step * reader.raw<std::int16_t>();
  const auto steps = reader.raw<std::int8_t>();
  return steps == coarse_nan ? std::numeric_limits<double>::quiet_NaN() : coarse_step * steps;
}

double length(ByteReader& reader, Numbers numbers) {
  const double value = std::abs(number(reader, numbers));
  return std::isfinite(value) ? value : 0;
}

oracle::Shape shape(ByteReader& reader, Numbers numbers) {
  oracle::Shape result;
  const std::uint32_t vertices = 1 + reader.below(most_vertices);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const double x = number(reader, numbers);
    const double y = number(reader, numbers);
    result.positions.emplace_back(x, y, number(reader, numbers));
  }
  const std::uint32_t faces = 1 + reader.below(most_faces);
  for (std::uint32_t i = 0; i < faces; ++i) {
    std::vector<std::uint32_t> face(3 + reader.below(2));
    for (std::uint32_t& corner : face) corner = reader.below(vertices);
    result.faces.push_back(std::move(face));
  }
  return result;
}

PairAsk read_ask(ByteReader& reader, Numbers numbers) {
  PairAsk ask;
  ask.detail = enumerators<ContactDetail>[reader.below(enumerators<ContactDetail>.size())];
  const std::uint32_t mode = reader.below(8);
  if (reader.once_in(4))
    ask.reach = length(reader, numbers);
  else
    ask.reach = std::numeric_limits<double>::infinity();
  if (mode == 1) {
    ask.mode = AccuracyMode::within;
    ask.tolerance = length(reader, numbers);
  }
  if (mode == 2) ask.work_limit = reader.below(16);
  if (mode == 3) {
    ask.mode = AccuracyMode::paper;
    ask.detail = reader.flag() ? ContactDetail::regions : ContactDetail::vertices;
    for (std::uint32_t count = reader.below(4); count > 0; --count)
      ask.epsilon.push_back(length(reader, numbers));
  }
  return ask;
}

void put(std::string& bytes, double value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);  // NOLINT: its bytes are what is wanted
}

bool is_coarse(const tests::TwoShapes& shapes) {
  const auto fits = [](double value) {
    const double steps = value / coarse_step;
    return std::isnan(value) || (steps == std::floor(steps) && std::abs(steps) < -coarse_nan);
  };
  bool all = fits(shapes.threshold);
  for (const oracle::Shape* shape : {&shapes.a, &shapes.b})
    for (const Eigen::Vector3d& position : shape->positions)
      for (const double value : position) all = all && fits(value);
  return all;
}

}  // namespace

PairCase read_pair_case(ByteReader reader) {
  const auto numbers = static_cast<Numbers>(reader.below(3));
  PairCase result;
  result.ask = read_ask(reader, numbers);
  result.shapes.threshold = length(reader, numbers);
  result.shapes.a = shape(reader, numbers);
  result.shapes.b = shape(reader, numbers);
  return result;
}

std::string pair_case_bytes(const tests::TwoShapes& shapes, ContactDetail detail) {
  const bool coarse = is_coarse(shapes);
  const auto add = [&](std::string& bytes, double value) {
    if (!coarse) return put(bytes, value);
    bytes += static_cast<char>(std::isnan(value) ? coarse_nan : static_cast<int>(value / coarse_step));
  };
  std::string bytes(1, static_cast<char>(coarse ? Numbers::coarse : Numbers::any));
  bytes += static_cast<char>(detail);
  bytes += std::string(2, '\0');
  add(bytes, shapes.threshold);
  for (const oracle::Shape* shape : {&shapes.a, &shapes.b}) {
    bytes += static_cast<char>(shape->positions.size() - 1);
    for (const Eigen::Vector3d& position : shape->positions)
      for (const double value : position) add(bytes, value);
    bytes += static_cast<char>(shape->faces.size() - 1);
    for (const auto& face : shape->faces) {
      bytes += static_cast<char>(face.size() - 3);
      for (const std::uint32_t corner : face) bytes += static_cast<char>(corner);
    }
  }
  return bytes;
}

std::string text_of(const PairAsk& ask) {
  std::string text = "detail " + std::string(name_of(ask.detail)) + ", " + std::string(name_of(ask.mode)) +
                     ", reach " + std::to_string(ask.reach) + ", tolerance " + std::to_string(ask.tolerance) +
                     ", work limit " + std::to_string(ask.work_limit) + ", epsilon";
  for (const double epsilon : ask.epsilon) text += " " + std::to_string(epsilon);
  return text + "\n";
}

}  // namespace graze::fuzz
