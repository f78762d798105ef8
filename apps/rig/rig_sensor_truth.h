// Reading truth.sensor of a rig.
#pragma once

#include "capture/sensor/sensor_truth.h"

namespace scattermeter::apps {

class YamlField;

// Throws InputError with file, line, field and value.
capture::SensorTruth read_sensor_truth(const YamlField& field);

}  // namespace scattermeter::apps
