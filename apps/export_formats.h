// Measured materials as the files of renderers and tables.
#pragma once

#include <string>
#include <vector>

#include "apps/result_reader.h"

namespace scattermeter::apps {

struct ExportOptions {
  double mm_per_unit = 1;  // length of a scene unit of the file, mm; > 0
  // Mean cosine of the phase function that is written, -1 < g < 1. What is measured is sigma_s' =
  // sigma_s (1 - g), which says nothing of g: 0 stands for the isotropic material that looks the
  // same, any other for what is known from elsewhere.
  double g = 0;
};

// What every file says of itself: lines without line ends.
std::vector<std::string> export_notes(const ReadResult& result, const ExportOptions& options);
// "POM R: sigma_s' 1.4 +- 0.002, sigma_a 0.002 +- 0.0001 per mm" for each channel.
std::vector<std::string> value_notes(const MeasuredMaterial& material);

// All of these: the text of a file. Materials of which none is refused (the CSV: any). The name of
// a material stands in it escaped as the format asks for.

// Mitsuba 3: a homogeneous medium and a smooth dielectric for its surface; a scene to include.
std::string mitsuba_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                         const ExportOptions& options);

// pbrt-v4: named medium, named dielectric for its surface, and a named `subsurface` material, which
// is both in one by pbrt's own BSSRDF.
std::string pbrt_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                      const ExportOptions& options);

// Blender 4.0 and later: a Python script that makes a Principled BSDF (random walk) of each
// material. Throws InputError for g other than 0, of which its colour knows nothing.
std::string blender_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                         const ExportOptions& options);

// MaterialX 1.39 with the node open_pbr_surface: OpenPBR subsurface colour and radius.
std::string openpbr_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                         const ExportOptions& options);

// MaterialX 1.38 and later with the nodes of its physically based library: a dielectric over an
// anisotropic volume of the measured coefficients.
std::string materialx_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                           const ExportOptions& options);

// One line a material and channel, per mm whatever the options. Values of refused channels are left
// empty; verdict and reasons stand beside them.
std::string csv_file(const std::vector<MeasuredMaterial>& materials);

}  // namespace scattermeter::apps
