#include "core/camera/cfa_pattern.h"

#include <stdexcept>

namespace scattermeter {

CfaPattern cfa_pattern_from_name(const std::string& name) {
  using enum Channel;
  if (name == "RGGB") return {{kRed, kGreen, kGreen, kBlue}};
  if (name == "GRBG") return {{kGreen, kRed, kBlue, kGreen}};
  if (name == "GBRG") return {{kGreen, kBlue, kRed, kGreen}};
  if (name == "BGGR") return {{kBlue, kGreen, kGreen, kRed}};
  throw std::invalid_argument("no Bayer pattern has the name '" + name + "'");
}

std::string cfa_pattern_name(const CfaPattern& pattern) {
  std::string name;
  for (const Channel channel : pattern.phase) name += "RGB"[static_cast<int>(channel)];
  return name;
}

}  // namespace scattermeter
