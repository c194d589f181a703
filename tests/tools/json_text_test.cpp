#include "text/json_text.hpp"

#include <bit>
#include <clocale>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "support/catch.hpp"

namespace {

using graze::io::JsonText;

/// Doubles of every size, sign and number of digits, the awkward ones first.
std::vector<double> awkward_doubles() {
  using Limits = std::numeric_limits<double>;
  std::vector<double> values = {
      0.0,           -0.0,          1,      -1,     0.1,    1e22, 1e23,
      5e-324,        Limits::min(), 0x1p60, 0x1p63, 0x1p64, 1e20, 123456789012345678.0,
      Limits::max(), -Limits::max()};
  std::mt19937_64 random(11);
  while (values.size() < 20000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  for (int i = 0; i < 2000; ++i) values.push_back(std::ldexp(static_cast<double>(random()), -30 - i % 40));
  return values;
}

void check_that_all_come_back() {
  std::size_t differing = 0;
  for (const double value : awkward_doubles()) {
    const std::string line = JsonText().open('[').real(value).close(']').line();
    const double read = nlohmann::json::parse(line).at(0).get<double>();
    if (std::bit_cast<std::uint64_t>(read) != std::bit_cast<std::uint64_t>(value)) ++differing;
  }
  CHECK(differing == 0);
}

}  // namespace

TEST_CASE("every finite double comes back from JSON with the same bits") {
  check_that_all_come_back();
}

TEST_CASE("a locale with a decimal comma changes no number") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  bool found = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"})
    found = found || std::setlocale(LC_ALL, name) != nullptr;
  if (!found) {
    WARN("skipped: no locale with a decimal comma is installed");
    return;
  }
  check_that_all_come_back();
  CHECK(JsonText().real(0.5).line() == "0.5");
  std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("doubles that JSON has no number for are words") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  JsonText json;
  json.open('[').real(infinity).real(-infinity).real(std::nan("")).close(']');
  CHECK(json.line() == R"(["infinity","-infinity",null])");
}

TEST_CASE("texts hold no control character, and come back as they were") {
  const std::string text = "a\x1b[2J\x7f\xC2\x9B\xC2\x80\xC2\xA0\n\xE2\x82\xAC";
  JsonText json;
  json.text(text);
  CHECK(json.line() == "\"a\\u001b[2J\\u007f\\u009b\\u0080\xC2\xA0\\n\xE2\x82\xAC\"");
  CHECK(nlohmann::json::parse(json.line()) == text);
}

TEST_CASE("commas stand between values and nowhere else, and texts are escaped") {
  JsonText json;
  json.open('{')
      .key("a")
      .open('[')
      .close(']')
      .key("b")
      .open('[')
      .whole(1)
      .open('{')
      .close('}')
      .flag(true)
      .close(']');
  json.key("c")
      .text("say \"\n\"[")
      .key("d")
      .point({1, -2.5, 0})
      .key("e")
      .text(std::string("\xff", 1))
      .close('}');
  CHECK(json.line() ==
        "{\"a\":[],\"b\":[1,{},true],\"c\":\"say \\\"\\n\\\"[\",\"d\":[1,-2.5,0],\"e\":\"\xEF\xBF\xBD\"}");
  CHECK_NOTHROW(nlohmann::json::parse(json.line()));
}
