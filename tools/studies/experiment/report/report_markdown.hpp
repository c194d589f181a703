#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "experiment/study.hpp"

namespace graze::tools {

/// Returns where the image of a study's figure is to be found. If it returns an empty string, the figure has
/// no image and is left out.
using ImageOf = std::function<std::string(const Study&, const Figure&)>;

/// Which pictures a page has.
enum class Pictures : std::uint8_t {
  of_studies,
  of_viewer_too,  ///< those that docs/experiments/make_pictures.mjs makes, in the folder `experiments`
};

/// The page of some studies: contents, and for each study its text, claims beside what was measured, tables
/// that are shown, and figures.
std::string markdown_of(std::span<const Study> studies, const ImageOf& image_of, Pictures pictures);

}  // namespace graze::tools
