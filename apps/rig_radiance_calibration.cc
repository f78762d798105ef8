#include "apps/rig_radiance_calibration.h"

namespace scattermeter::apps {

RigRadianceCalibration read_radiance_calibration(const YamlField& field,
                                                 const std::string& rig_path) {
  field.only({});
  static_cast<void>(rig_path);
  return {};
}

}  // namespace scattermeter::apps
