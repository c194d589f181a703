#include "figures/html_page.hpp"

#include <md4c-html.h>

#include <cstdint>
#include <graze/error.hpp>
#include <string_view>

namespace graze::tools {
namespace {

const char* style = R"(
:root { color-scheme: light dark; --line: #8886; --back: #fff; --fore: #1b1f24; --head: #eef1f4; --link: #0b5cad; }
@media (prefers-color-scheme: dark) { :root { --back: #14181d; --fore: #dfe4ea; --head: #232a32; --link: #7ab8ff; } }
body { max-width: 78rem; margin: 2rem auto; padding: 0 1rem; background: var(--back); color: var(--fore);
  font: 16px/1.55 system-ui, "DejaVu Sans", sans-serif; }
p, ul { max-width: 60rem; }
h1, h2 { line-height: 1.25; } h2 { margin-top: 3rem; border-bottom: 1px solid var(--line); padding-bottom: .3rem; }
a { color: var(--link); } code { font-size: .9em; }
table { border-collapse: collapse; display: block; overflow-x: auto; font-size: .86rem; margin: 1rem 0; }
th, td { border: 1px solid var(--line); padding: .25rem .6rem; vertical-align: top; }
td[align="right"] { white-space: nowrap; }
th { background: var(--head); } td { font-variant-numeric: tabular-nums; }
img { display: block; width: 100%; max-width: 900px; height: auto; margin: 1.2rem 0; border: 1px solid var(--line);
  background: #fff; border-radius: 4px; }
)";

void append(const MD_CHAR* text, MD_SIZE size, void* html) {
  static_cast<std::string*>(html)->append(text, size);
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '&')
      result += "&amp;";
    else if (letter == '<')
      result += "&lt;";
    else
      result += letter;
  }
  return result;
}

std::string base64_of(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t first = 0; first < bytes.size(); first += 3) {
    const std::string_view group = bytes.substr(first, 3);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8U | (i < group.size() ? static_cast<unsigned char>(group[i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i) text += i <= group.size() ? digits[bits >> (18 - 6 * i) & 63U] : '=';
  }
  return text;
}

}  // namespace

std::string html_of(const std::string& markdown, const std::string& title) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n<title>" +
      escaped(title) + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n";
  if (md_html(markdown.data(), static_cast<MD_SIZE>(markdown.size()), append, &html,
              MD_FLAG_TABLES | MD_FLAG_NOINDENTEDCODEBLOCKS, MD_HTML_FLAG_XHTML) != 0)
    throw Error("the page could not be made of its Markdown");
  return html + "</body>\n</html>\n";
}

std::string data_address_of(const std::string& svg) {
  return "data:image/svg+xml;base64," + base64_of(svg);
}

}  // namespace graze::tools
