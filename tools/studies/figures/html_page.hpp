#pragma once

#include <string>

namespace graze::tools {

/// A page of Markdown as one HTML file that needs no other. Throws graze::Error for a text that the
/// converter refuses.
std::string html_of(const std::string& markdown, const std::string& title);

/// An SVG as an address that holds all of it.
std::string data_address_of(const std::string& svg);

}  // namespace graze::tools
