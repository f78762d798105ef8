// What the head of an ordinary picture claims, before a library takes memory for it.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>

namespace scattermeter::capture {

struct PictureClaim {
  std::uint32_t width_px = 0;   // > 0
  std::uint32_t height_px = 0;  // > 0
  // What a decoder takes memory for at once: the picture, or a tile or strip of a TIFF where that
  // is larger.
  double pixels = 0;
};

// By the first bytes, whatever the file's name ends in: JPEG, PNG, classic TIFF (its first
// directory), BMP, PBM/PGM/PPM, WebP. nullopt for any other file, and where the head is cut off,
// contradicts itself or names no size. Reads the head alone; nothing it says is taken for true.
std::optional<PictureClaim> picture_claim(std::istream& file);

}  // namespace scattermeter::capture
