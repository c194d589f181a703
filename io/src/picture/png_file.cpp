#include "picture/png_file.hpp"

#include <png.h>

#include <graze/io/error.hpp>

namespace graze::io {

void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, path.string().c_str(), 0, rgb.data(), 0, nullptr) == 0)
    throw InputError(path.string() + ": cannot be written (" + image.message +
                     "); check that its folder exists and may be written to");
}

}  // namespace graze::io
