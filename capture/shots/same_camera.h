// Comparison of camera names.
#pragma once

#include <string>

namespace scattermeter::capture {

// Whether `wanted` names the camera of `make` and `model`, with or without the make, case ignored:
// "NIKON D80", "Nikon D80" and "D80" are the same camera, as LibRaw shortens makes and removes them
// from models.
bool same_camera(const std::string& wanted, const std::string& make, const std::string& model);

}  // namespace scattermeter::capture
