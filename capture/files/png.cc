#include "capture/files/png.h"

#include <array>
#include <map>
#include <stdexcept>
#include <string>

#include <png.h>

namespace scattermeter::capture {
namespace {

constexpr std::size_t kPalette = 256;

}  // namespace

std::vector<std::uint8_t> png_of_rgb(int width_px, int height_px,
                                     std::span<const std::uint8_t> rgb) {
  if (width_px <= 0 || height_px <= 0 ||
      rgb.size() != 3U * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("png_of_rgb: " + std::to_string(width_px) + " x " +
                                std::to_string(height_px) + " pixels of " +
                                std::to_string(rgb.size()) + " values");
  }
  // Where there are few colours, a byte for each pixel.
  std::map<std::array<std::uint8_t, 3>, std::uint8_t> index_of;
  std::vector<std::uint8_t> palette, indices;
  for (std::size_t i = 0; i < rgb.size() && palette.size() <= 3U * kPalette; i += 3) {
    const auto [at, is_new] =
        index_of.try_emplace({rgb[i], rgb[i + 1], rgb[i + 2]}, static_cast<std::uint8_t>(0));
    if (is_new) {
      at->second = static_cast<std::uint8_t>(palette.size() / 3U);
      palette.insert(palette.end(), {rgb[i], rgb[i + 1], rgb[i + 2]});
    }
    indices.push_back(at->second);
  }
  const bool is_indexed = palette.size() <= 3U * kPalette;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = is_indexed ? PNG_FORMAT_RGB_COLORMAP : PNG_FORMAT_RGB;
  image.colormap_entries = static_cast<png_uint_32>(palette.size() / 3U);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::uint8_t> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0,
                                is_indexed ? indices.data() : rgb.data(), 0,
                                is_indexed ? palette.data() : nullptr) == 0) {
    throw std::runtime_error("png_of_rgb: " + std::string(&image.message[0]));
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace scattermeter::capture
