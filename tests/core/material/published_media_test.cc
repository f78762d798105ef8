#include "core/material/published_media.h"

#include <map>

#include <gtest/gtest.h>

#include "core/material/dipole.h"

namespace scattermeter {
namespace {

// The authors state the diffuse reflectance of each material beside its coefficients (figure 5),
// which follow from it by their dipole: a wrong digit in either coefficient would show.
TEST(PublishedMedia, ReflectAsTheAuthorsState) {
  const std::map<std::string_view, std::array<double, 3>> reflectance = {
      {"apple", {0.85, 0.84, 0.53}},      {"chicken1", {0.31, 0.15, 0.10}},
      {"chicken2", {0.32, 0.16, 0.10}},   {"cream", {0.98, 0.90, 0.73}},
      {"ketchup", {0.16, 0.01, 0.00}},    {"marble", {0.83, 0.79, 0.75}},
      {"potato", {0.77, 0.62, 0.21}},     {"skimmilk", {0.81, 0.81, 0.69}},
      {"skin1", {0.44, 0.22, 0.13}},      {"skin2", {0.63, 0.44, 0.34}},
      {"spectralon", {1.00, 1.00, 1.00}}, {"wholemilk", {0.91, 0.88, 0.76}}};
  ASSERT_EQ(published_materials().size(), reflectance.size());
  for (const PublishedMaterial& m : published_materials()) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Medium medium{m.sigma_s_prime_per_mm[c], m.sigma_a_per_mm[c], m.eta_int_over_ext};
      EXPECT_NEAR(Dipole(medium).total_reflectance(), reflectance.at(m.name)[c], 0.03)
          << m.name << " " << c;
    }
  }
}

}  // namespace
}  // namespace scattermeter
