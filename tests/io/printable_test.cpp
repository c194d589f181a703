// Texts of strangers that reach a terminal: graze::io::printable, and the messages that it is applied to.

#include <graze/io/error.hpp>
#include <graze/io/printable.hpp>
#include <random>

#include "io/import_support.hpp"

namespace {

using graze::io::printable;
using namespace graze::tests;

/// Whether a terminal obeys a part of a text of UTF-8: a control character, in one byte or in two.
bool has_control(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (byte < 0x20 || byte == 0x7F || (byte == 0xC2 && next < 0xA0)) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("printable spells out what a terminal obeys, and leaves every other text as it is") {
  CHECK(printable("") == "");
  for (const std::string text : {"liver", "naïve – 肝臓 🦴", "a\\x1b", "~ !\"$"})
    CHECK(printable(text) == text);
  CHECK(printable("\x1b[31mred\x1b[0m") == "\\x1b[31mred\\x1b[0m");
  CHECK(printable("\x1b]0;title\x07") == "\\x1b]0;title\\x07");
  CHECK(printable("two\nlines\r and\ta tab") == "two lines  and a tab");
  CHECK(printable(std::string("a\0b\x7f", 4)) == "a\\x00b\\x7f");
  CHECK(printable("\xC2\x9B"
                  "31m") == "\\x9b31m");  // the CSI of one character
  CHECK(printable("\x9B"
                  "31m") == "\\x9b31m");                        // the same in Latin-1
  CHECK(printable("\xE2\x80\xAEgpj.exe") == "\\u202egpj.exe");  // writes from right to left
}

TEST_CASE("printable spells out bytes that are not UTF-8") {
  CHECK(printable("\xC0\xAF") == "\\xc0\\xaf");                    // overlong
  CHECK(printable("\xE0\x80\x8A") == "\\xe0\\x80\\x8a");           // overlong
  CHECK(printable("\xED\xA0\x80") == "\\xed\\xa0\\x80");           // a surrogate
  CHECK(printable("\xF4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond the last code
  CHECK(printable("\xE8\x82") == "\\xe8\\x82");                    // cut off
  CHECK(printable("\xE8\x82z") == "\\xe8\\x82z");
}

TEST_CASE("printable gives no control character, and the same again, for any bytes") {
  std::mt19937 random(7);
  const std::string bytes("\x1b\x9b\xc2\xe2\x80\xaez\n\x85\xf0\x9f\x00", 12);
  for (int round = 0; round < 2000; ++round) {
    std::string text;
    for (std::size_t i = random() % 12; i > 0; --i)
      text += random() % 2 == 0 ? bytes[random() % bytes.size()] : static_cast<char>(random() % 256);
    const std::string shown = printable(text);
    CHECK_FALSE(has_control(shown));
    CHECK(printable(shown) == shown);
  }
}

TEST_CASE("messages and warnings about files hold no control character of the file") {
  CHECK(graze::io::InputError("a\x1b[2J\nb").what() == std::string("a\\x1b[2J b"));
  const TemporaryFolder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0 0\n";
  CHECK_FALSE(has_control(refusal_of(folder.write("a.obj", vertices + "g \x1b]0;x\x07\nf 1 2 \x1b[2J\n"))));
  const auto file =
      graze::io::MeshFile::read(folder.write("b.obj", vertices + "g \x1b]0;x\x07\nf 1 2 3 4 5\n"));
  REQUIRE(file.warnings().size() == 1);
  CHECK_THAT(file.warnings()[0], Catch::Matchers::Contains("object '\\x1b]0;x\\x07'"));
  CHECK(file.objects()[0].name == "\x1b]0;x\x07");  // a name itself stays as it is
}

TEST_CASE("a message about damaged glTF says where it is damaged, without a library's name for it") {
  const TemporaryFolder folder;
  CHECK_THAT(refusal_of(folder.write("a.gltf", "{\n  x")),
             Catch::Matchers::Contains("its JSON cannot be read (parse error at line 2, column 3"));
}
