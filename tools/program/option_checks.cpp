#include "option_checks.hpp"

#include <charconv>
#include <cmath>
#include <graze/settings.hpp>
#include <optional>

namespace graze::tools {
namespace {

/// The number that a whole text is; nothing where it is none.
template <typename Number>
std::optional<Number> number_of(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, number);
  if (problem != std::errc{} || stop != end) return std::nullopt;
  return number;
}

bool is_in(NumberRange range, double number) {
  if (range == NumberRange::above_0) return number > 0 && std::isfinite(number);
  return number >= 0 && (range == NumberRange::at_least_0_or_infinite || std::isfinite(number));
}

}  // namespace

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most, const std::string& reason) {
  const bool has_end = most < std::numeric_limits<std::uint32_t>::max();
  const std::string from = std::to_string(least), to = std::to_string(most);
  const std::string range = has_end ? "from " + from + " to " + to : "of at least " + from;
  return {[=](std::string& text) {
            const auto number = number_of<std::uint64_t>(text);
            if (number && *number >= least && *number <= most) return std::string();
            const bool is_above = number && *number > most;
            return "expected a whole number " + (is_above && !has_end ? "of at most " + to : range) + reason +
                   ", got \"" + text + "\"";
          },
          range};
}

CLI::Validator real_number(NumberRange range) {
  std::string expected = "a number above 0";
  if (range == NumberRange::at_least_0) expected = "a number that is not negative";
  if (range == NumberRange::at_least_0_or_infinite) expected = "a number that is not negative, or inf";
  return {[=](std::string& text) {
            const auto number = number_of<double>(text);
            const bool is_good = number && is_in(range, *number);
            return is_good ? std::string() : "expected " + expected + ", got \"" + text + "\"";
          },
          range == NumberRange::above_0 ? "above 0" : "at least 0"};
}

CLI::Validator thread_number() {
  return whole_number(1, max_threads(), " (8 for each processor)");
}

CLI::Validator file_name() {
  return {[](std::string& text) {
            return text.empty() ? std::string("expected the name of a file, got nothing") : std::string();
          },
          ""};
}

}  // namespace graze::tools
