// Limits on the sizes that files may claim.
#pragma once

namespace scattermeter::apps {

class YamlField;

// A file that claims more is refused before memory is allocated for it; the message names the key.
struct RigLimits {
  double raw_megapixels = 400;         // of a raw, and of camera.image_size_px
  double probe_megapixels = 64;        // of the picture of an environment
  double mesh_triangles = 20'000'000;  // of an object
};

// Reads `limits` at the top of a rig, if it is there. Throws InputError.
RigLimits read_limits(const YamlField& top);

// Throws InputError for a camera.image_size_px of more than raw_megapixels.
void check_image_size(const YamlField& image_size_px, const RigLimits& limits);

}  // namespace scattermeter::apps
