#pragma once

#include <span>
#include <string>

namespace graze::tools {

/// Whether the program was built with the viewer, which needs Node.js and npm.
bool has_viewer();

/// The text of the viewer's page. Throws io::InputError, which says how to get a viewer, if the program was
/// built without one.
std::string viewer_page();

/// The text that was packed by gzip. Throws io::InputError as viewer_page() if there are no bytes.
std::string unpacked_viewer(std::span<const unsigned char> packed);

/// The viewer's page as gzip writes it, in a source that the build writes. It is empty without a viewer.
extern const std::span<const unsigned char> packed_viewer;

}  // namespace graze::tools
