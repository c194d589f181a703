#pragma once

#include <functional>
#include <span>
#include <string>

#include "experiment/study.hpp"

namespace graze::tools {

/// Returns where the image of a study's figure is to be found. If it returns an empty string, the figure has
/// no image and is left out.
using ImageOf = std::function<std::string(const Study&, const Figure&)>;

/// The page of some studies: contents, and for each study its text, claims beside what was measured, tables
/// that are shown, and figures.
std::string markdown_of(std::span<const Study> studies, const ImageOf& image_of);

}  // namespace graze::tools
