// A result.json that nobody measured.
#pragma once

#include <array>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

namespace scattermeter::apps {

struct MadeMaterial {
  std::array<double, 3> sigma_s_prime, sigma_a;  // per mm
};
using MadeMaterials = std::map<std::string, MadeMaterial>;

inline nlohmann::json made_quantity(double value) {
  return {{"value", value}, {"std", value / 4}, {"interval95", {value / 2, value * 2}}};
}

// Every channel ok, by the dipole.
inline nlohmann::json made_result(const MadeMaterials& materials, double eta = 1.4) {
  nlohmann::json j = {{"version", "0.1.0"},
                      {"command", "scattermeter measure -- shots"},
                      {"results", nlohmann::json::array()}};
  for (const auto& [name, material] : materials) {
    for (std::size_t c = 0; c < 3; ++c) {
      j["results"].push_back({{"material", name},
                              {"channel", std::string(1, "RGB"[c])},
                              {"model", "dipole"},
                              {"eta", eta},
                              {"verdict", "ok"},
                              {"reasons", nlohmann::json::array()},
                              {"correlation", 0.5},
                              {"sigma_s_prime_per_mm", made_quantity(material.sigma_s_prime[c])},
                              {"sigma_a_per_mm", made_quantity(material.sigma_a[c])}});
    }
  }
  return j;
}

}  // namespace scattermeter::apps
