// The file formats to which measured materials are exported, for renderers and as tables.
#pragma once

#include <string>
#include <vector>

#include "apps/results/result_reader.h"

namespace scattermeter::apps {

struct ExportOptions {
  double mm_per_unit = 1;  // length of a scene unit of the file, mm; > 0
  // Mean cosine of the phase function to write, -1 < g < 1. The measured sigma_s' = sigma_s (1 - g)
  // does not determine g: 0 stands for the isotropic material of the same appearance, any other
  // value must be known from elsewhere.
  double g = 0;
};

// Each of these functions returns the text of a file. None of the materials is refused (for CSV:
// any may be). Material names are escaped as the format requires.

// Mitsuba 3: a homogeneous medium and a smooth dielectric for its surface, in a scene to include.
std::string mitsuba_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                         const ExportOptions& options);

// pbrt-v4: a named medium, a named dielectric for its surface, and a named `subsurface` material,
// which combines both by pbrt's own BSSRDF.
std::string pbrt_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                      const ExportOptions& options);

// Blender 4.0 and later: a Python script that makes a Principled BSDF (random walk) of each
// material. Throws InputError for g other than 0, which its colour cannot express.
std::string blender_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                         const ExportOptions& options);

// MaterialX 1.39 with the node open_pbr_surface: OpenPBR subsurface colour and radius.
std::string openpbr_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                         const ExportOptions& options);

// MaterialX 1.38 and later with its physically based nodes: a dielectric over an anisotropic volume
// with the measured coefficients.
std::string materialx_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                           const ExportOptions& options);

// One row for each material and channel, per mm whatever the options. The values of refused
// channels are left empty; verdict and reasons are given for all.
std::string csv_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                     const ExportOptions& options);

struct ExportFormat {
  const char* name;         // value of the option --format
  const char* description;  // in --help
  double mm_per_unit;       // default of ExportOptions::mm_per_unit
  bool takes_refused;       // refused channels are written, too
  std::string (*text)(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                      const ExportOptions& options);
};

// All formats in the order of --help. A new format is declared above and added here.
inline constexpr ExportFormat kExportFormats[] = {
    {"mitsuba", "Mitsuba 3 medium (XML)", 1, false, mitsuba_file},
    {"pbrt", "pbrt-v4 medium and material", 1, false, pbrt_file},
    {"blender", "script that makes Principled materials", 1000, false, blender_file},
    {"openpbr", "OpenPBR surface (MaterialX 1.39)", 1, false, openpbr_file},
    {"materialx", "physically based nodes", 1000, false, materialx_file},
    {"csv", "values with uncertainties", 1, true, csv_file}};

}  // namespace scattermeter::apps
