#include "capture/sensor/radiance_correction.h"

#include <cmath>

namespace scattermeter::capture {

ShutterSetting RadianceCorrection::setting(double stated_s) const {
  for (const ShutterSetting& s : shutter) {
    if (std::abs(s.stated_s - stated_s) <= 1e-3 * stated_s) return s;
  }
  return {stated_s, 1.0, shutter_relative_std};
}

}  // namespace scattermeter::capture
