#include "text/json_path.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <graze/io/error.hpp>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

#include "text/opened_files.hpp"

namespace graze::io {
namespace {

std::string read_text(const std::filesystem::path& path) {
  std::ifstream stream = open_input(path);
  if (!stream || std::filesystem::is_directory(path))
    throw InputError(path.string() + ": cannot be opened; check that the file exists and may be read");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// `line 3, column 14` of the byte before `end` (counted from 1, as the parser counts).
std::string line_and_column(std::string_view text, std::size_t end) {
  const std::string_view before = text.substr(0, std::min(text.size(), end == 0 ? 0 : end - 1));
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - line_start + 1);
}

/// Something that people often write and JSON does not have, and where it stands.
struct Mistake {
  std::size_t at = 0;
  std::string_view what;
};

/// Looks for such a mistake where the parser stopped, at `at`.
std::optional<Mistake> common_mistake(std::string_view text, std::size_t at) {
  constexpr std::string_view comment = "a comment stands here, which JSON does not have; remove it";
  const auto char_at = [&](std::size_t index) { return index < text.size() ? text[index] : '\0'; };
  for (const std::size_t start : {at, at - 1})
    if (char_at(start) == '/' && (char_at(start + 1) == '/' || char_at(start + 1) == '*'))
      return Mistake{start, comment};
  if (char_at(at) == '#') return Mistake{at, comment};
  if (char_at(at) != ']' && char_at(at) != '}') return std::nullopt;
  const std::size_t before = text.substr(0, at).find_last_not_of(" \t\r\n");
  if (before == std::string_view::npos || text[before] != ',') return std::nullopt;
  return Mistake{before, "a trailing comma stands before a closing bracket; remove the comma"};
}

/// Refuses a key that an object has twice (the parser would keep the last without a word), and values so deep
/// that showing them, which recurses, would end the stack.
class Guard {
 public:
  explicit Guard(std::string file) : file_(std::move(file)) {}

  bool operator()(int depth, nlohmann::json::parse_event_t event, const nlohmann::json& parsed) {
    constexpr int deepest = 200;
    using Event = nlohmann::json::parse_event_t;
    if (depth > deepest)
      throw InputError(file_ + ": nested deeper than " + std::to_string(deepest) +
                       " levels; write it without the brackets");
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end) open_.pop_back();
    if (event == Event::key && !open_.back().insert(parsed.get<std::string>()).second)
      throw InputError(file_ + ": key \"" + parsed.get<std::string>() +
                       "\" stands twice in one object; keep one");
    return true;
  }

 private:
  std::string file_;
  std::vector<std::set<std::string>> open_;
};

std::string shown(const nlohmann::json& value) {
  constexpr std::size_t longest = 60;
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

}  // namespace

nlohmann::json parse_json_file(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  try {
    Guard guard(path.string());
    return nlohmann::json::parse(text, std::ref(guard));
  } catch (const nlohmann::json::parse_error& error) {
    const auto mistake = common_mistake(text, error.byte == 0 ? 0 : error.byte - 1);
    if (mistake)
      throw InputError(path.string() + ": " + line_and_column(text, mistake->at + 1) + ": " +
                       std::string(mistake->what));
    throw InputError(path.string() + ": " + line_and_column(text, error.byte) +
                     ": not valid JSON; look there for a missing comma, quote or bracket");
  } catch (const nlohmann::json::exception&) {
    throw InputError(path.string() + ": holds a number too large for a double; write a smaller one");
  }
}

std::string JsonPath::where() const {
  return path_.empty() ? file_ : file_ + ": " + path_;
}

void JsonPath::fail(std::string_view expected, std::string_view remedy) const {
  throw InputError(where() + ": expected " + std::string(expected) + ", got " + shown(*value_) + "; " +
                   std::string(remedy));
}

void JsonPath::refuse(std::string_view problem) const {
  throw InputError(where() + ": " + std::string(problem));
}

std::string_view JsonPath::key() const {
  return std::string_view(path_).substr(path_.rfind('.') + 1);
}

void JsonPath::expect_keys(std::span<const std::string_view> keys) const {
  if (!value_->is_object()) fail("an object", "write { } with keys inside");
  for (const auto& [key, unused] : value_->items()) {
    if (std::ranges::find(keys, key) != keys.end()) continue;
    std::string known;
    for (const std::string_view name : keys) known += (known.empty() ? "" : ", ") + std::string(name);
    throw InputError(find(key)->where() + ": unknown key; known here are " + known);
  }
}

std::optional<JsonPath> JsonPath::find(std::string_view key) const {
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonPath(file_, path_ + (path_.empty() ? "" : ".") + std::string(key), *found);
}

JsonPath JsonPath::require(std::string_view key, std::string_view remedy) const {
  if (auto found = find(key)) return *found;
  throw InputError(where() + ": key \"" + std::string(key) + "\" is missing; " + std::string(remedy));
}

std::size_t JsonPath::array_size(std::string_view remedy) const {
  if (!value_->is_array()) fail("an array", remedy);
  return value_->size();
}

JsonPath JsonPath::item(std::size_t index) const {
  return {file_, path_ + "[" + std::to_string(index) + "]", (*value_)[index]};
}

double JsonPath::number() const {
  if (!value_->is_number()) fail("a number", "write one without quotes, such as 0.5");
  return value_->get<double>();
}

bool JsonPath::truth() const {
  if (!value_->is_boolean()) fail("true or false", "write one of them, without quotes");
  return value_->get<bool>();
}

double JsonPath::number_not_negative() const {
  if (!value_->is_number() || value_->get<double>() < 0)
    fail("a number that is not negative", "write 0 or more, without quotes");
  return value_->get<double>();
}

double JsonPath::number_positive() const {
  if (!value_->is_number() || value_->get<double>() <= 0)
    fail("a number above 0", "write one without quotes, such as 0.5");
  return value_->get<double>();
}

std::uint32_t JsonPath::whole_number(std::uint32_t least, std::uint32_t most) const {
  const bool fits = value_->is_number_unsigned() && value_->get<std::uint64_t>() >= least &&
                    value_->get<std::uint64_t>() <= most;
  if (!fits)
    fail("a whole number from " + std::to_string(least) + " to " + std::to_string(most),
         "write one without quotes");
  return value_->get<std::uint32_t>();
}

std::string JsonPath::text() const {
  if (!value_->is_string() || value_->get_ref<const std::string&>().empty())
    fail("a text", "write it in double quotes, not empty");
  return value_->get<std::string>();
}

std::vector<double> JsonPath::numbers(std::size_t count, std::string_view remedy) const {
  if (!value_->is_array() || value_->size() != count) fail(std::to_string(count) + " numbers", remedy);
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(item(i).number());
  return values;
}

Eigen::Vector3d JsonPath::point() const {
  if (!value_->is_array() || value_->size() != 3) fail("three numbers", "write [x, y, z]");
  return {item(0).number(), item(1).number(), item(2).number()};
}

}  // namespace graze::io
