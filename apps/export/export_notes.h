// Comments that every exported file starts with.
#pragma once

#include <string>
#include <vector>

#include "apps/export/export_formats.h"

namespace scattermeter::apps {

// Origin of the values, scale, phase function and meaning of the channels: lines without line ends.
std::vector<std::string> export_notes(const ReadResult& result, const ExportOptions& options);

// "POM R: sigma_s' 1.4 +- 0.002 per mm, sigma_a 0.002 +- 0.0001 per mm, ..." for each channel.
std::vector<std::string> value_notes(const MeasuredMaterial& material);

}  // namespace scattermeter::apps
