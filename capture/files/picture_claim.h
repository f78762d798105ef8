// The size claimed in the header of an ordinary picture, checked before a library allocates memory.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>

namespace scattermeter::capture {

struct PictureClaim {
  std::uint32_t width_px = 0;   // > 0
  std::uint32_t height_px = 0;  // > 0
  // The number of pixels that a decoder allocates at once: those of the picture, or of a TIFF's
  // tile or strip if that is larger.
  double pixels = 0;
};

// "JPEG", "PNG", "BMP", "TIFF", "WebP" or "PNM" by the first bytes of the file; "" for any other.
std::string picture_kind(std::istream& file);

// Reads the header of a JPEG, PNG, classic TIFF (first directory), BMP, PBM/PGM/PPM or WebP file,
// as recognised by its first bytes and not by its name. nullopt for any other file, for one
// that is marked as DICOM besides, and when the header is truncated, inconsistent or without a
// size. Nothing in the header is trusted.
std::optional<PictureClaim> picture_claim(std::istream& file);

}  // namespace scattermeter::capture
