#include "core/sweep/sequence.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>

#include "core/mesh_files.hpp"

namespace graze::tests {
namespace {

std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The whole numbers of a text, two by two.
std::vector<std::array<std::size_t, 2>> read_pairs(const std::filesystem::path& file) {
  std::string text = text_of_file(file);
  for (char& character : text)
    if (character < '0' || character > '9') character = ' ';
  std::istringstream numbers(text);
  std::vector<std::array<std::size_t, 2>> pairs;
  std::array<std::size_t, 2> pair{};
  while (numbers >> pair[0] >> pair[1]) pairs.push_back(pair);
  return pairs;
}

/// The words "true" and "false" of a text.
std::vector<bool> read_answers(const std::filesystem::path& file) {
  std::vector<bool> answers;
  for (const char character : text_of_file(file))
    if (character == 't' || character == 'f') answers.push_back(character == 't');
  return answers;
}

/// All edges, in the order of their larger ends.
std::vector<std::array<std::uint32_t, 2>> edges_by_larger_end(const oracle::Shape& shape) {
  std::set<std::array<std::uint32_t, 2>> by_larger_end;
  for (const auto& face : shape.faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const auto [low, high] = std::minmax(face[i], face[(i + 1) % face.size()]);
      by_larger_end.insert({high, low});
    }
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& edge : by_larger_end) edges.push_back({edge[1], edge[0]});
  return edges;
}

}  // namespace

std::optional<Sequence> read_sequence(const std::string& name, int first) {
  const std::filesystem::path folder = std::filesystem::path(GRAZE_SHARED_DATA) / "sequences" / name;
  if (!std::filesystem::exists(folder)) {
    std::cout << "skipped: there is no " << folder.string() << "\n";
    return std::nullopt;
  }
  const auto frame = [&](int number) {
    return read_ply((folder / "frames" / (std::to_string(number) + ".ply")).string());
  };
  Sequence sequence;
  sequence.start = frame(first);
  sequence.end = frame(first + 1).positions;
  sequence.edges = edges_by_larger_end(sequence.start);
  // The files number all vertices first, then all edges, then all faces.
  const std::size_t first_edge = sequence.start.positions.size();
  const std::size_t first_face = first_edge + sequence.edges.size();
  for (const bool are_edges : {false, true}) {
    const std::string file = std::to_string(first) + (are_edges ? "ee" : "vf");
    const auto pairs = read_pairs(folder / "boxes" / (file + ".json"));
    const auto answers = read_answers(folder / "mma_bool" / (file + "_mma_bool.json"));
    if (pairs.empty() || pairs.size() != answers.size()) throw std::runtime_error("bad sequence " + name);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [a, b] = pairs[i];
      const std::array<std::size_t, 2> of_edges = {a - first_edge, b - first_edge};
      sequence.pairs.push_back({are_edges, are_edges ? of_edges : std::array{a, b - first_face}, answers[i]});
    }
  }
  return sequence;
}

}  // namespace graze::tests
