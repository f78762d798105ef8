// Inputs for decoding the shots of a scene, besides the scene.
#pragma once

#include <memory>
#include <string>

namespace scattermeter::capture {

struct RadianceCalibration;  // capture/sensor/radiance_calibration.h

struct ShotDecoding {
  // Null: no correction, and the noise of the scene's sensor.
  std::shared_ptr<const RadianceCalibration> radiance;
  std::string radiance_path;    // path of its file; "": made in code
  double max_megapixels = 400;  // a raw file that claims more is refused
};

}  // namespace scattermeter::capture
