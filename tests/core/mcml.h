// MCML's radial profiles of a half-space, where they are at hand.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/scattering_medium.h"

namespace scattermeter::test_support {

struct McmlCase {
  const char* name;
  ScatteringMedium medium;
  double specular;
  double photons;
};
inline const std::array<McmlCase, 3> kMcmlCases = {
    {{"mcml_skin1_G_g00.csv", {0.88, 0.17, 0.0, 1.3}, 0.0170132, 1e6},
     {"mcml_skimmilk_G_g00.csv", {1.22, 0.0025, 0.0, 1.3}, 0.0170132, 2e5},
     {"mcml_marble_G_g00.csv", {2.62, 0.0041, 0.0, 1.5}, 0.04, 2e5}}};

inline constexpr double kMcmlBinMm = 0.2;

// Power that leaves through each ring, from the axis outwards, of one unit sent; empty where the
// file is not there. `path`: where it should be.
inline std::vector<double> mcml_ring_power(const McmlCase& c, std::string& path) {
  const char* shared = std::getenv("SCATTERMETER_SHARED");
  path = std::string(shared != nullptr ? shared : SCATTERMETER_SHARED_DEFAULT) +
         "/data/reference/" + c.name;
  std::ifstream in(path);
  std::vector<double> power;
  for (std::string line; std::getline(in, line);) {
    double r = 0.0, value = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf", &r, &value) != 2) continue;
    power.push_back(2.0 * std::numbers::pi * r * kMcmlBinMm * value);
  }
  return power;
}

}  // namespace scattermeter::test_support
