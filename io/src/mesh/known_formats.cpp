#include "mesh/known_formats.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace graze::io {

std::optional<std::string> name_of_unread_format(std::string_view extension) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 32> formats = {{
      {".vtk", "VTK"},
      {".vtp", "VTK"},
      {".vtu", "VTK"},
      {".msh", "Gmsh or ANSYS"},
      {".abc", "Alembic"},
      {".usd", "USD"},
      {".usda", "USD"},
      {".usdc", "USD"},
      {".usdz", "USD"},
      {".step", "STEP"},
      {".stp", "STEP"},
      {".iges", "IGES"},
      {".igs", "IGES"},
      {".brep", "Open CASCADE"},
      {".sldprt", "SolidWorks"},
      {".sldasm", "SolidWorks"},
      {".ipt", "Inventor"},
      {".3dm", "Rhino"},
      {".skp", "SketchUp"},
      {".max", "3ds Max"},
      {".ma", "Maya"},
      {".mb", "Maya"},
      {".c4d", "Cinema 4D"},
      {".vrm", "VRM"},
      {".drc", "Draco"},
      {".splat", "Gaussian splats"},
      {".jt", "JT"},
      {".inp", "Abaqus"},
      {".bdf", "Nastran"},
      {".nii", "NIfTI"},
      {".dcm", "DICOM"},
      {".mat", "MATLAB"},
  }};
  const auto* const found =
      std::ranges::find(formats, extension, &std::pair<std::string_view, std::string_view>::first);
  if (found == formats.end()) return std::nullopt;
  return std::string(found->second);
}

}  // namespace graze::io
