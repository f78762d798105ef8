#include "capture/files/png.h"

#include <stdexcept>
#include <string>

#include <png.h>

namespace scattermeter::capture {

std::vector<std::uint8_t> png_of_rgb(int width_px, int height_px,
                                     std::span<const std::uint8_t> rgb) {
  if (width_px <= 0 || height_px <= 0 ||
      rgb.size() != 3U * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("png_of_rgb: " + std::to_string(width_px) + " x " +
                                std::to_string(height_px) + " pixels of " +
                                std::to_string(rgb.size()) + " values");
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::uint8_t> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr) == 0) {
    throw std::runtime_error("png_of_rgb: " + std::string(&image.message[0]));
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace scattermeter::capture
