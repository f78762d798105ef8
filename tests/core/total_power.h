// All the light that enters an object.
#pragma once

#include "core/incident_light.h"

namespace scattermeter::test_support {

inline double total(const IncidentLight& light) {
  double sum = 0.0;
  for (double c : light.patch_power_sr) sum += c;
  return sum;
}

}  // namespace scattermeter::test_support
