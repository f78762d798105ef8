#include "core/light/transmitted_cosine.h"

#include <gtest/gtest.h>

#include "core/material/fresnel.h"

namespace scattermeter {
namespace {

TEST(TransmittedCosine, IsTheFresnelEquations) {
  for (const double eta : {1.0, 1.05, 1.3, 1.5, 4.0}) {
    const TransmittedCosine transmitted(eta);
    for (int i = 0; i < 30'011; ++i) {
      const double c = i / 30'010.0;
      ASSERT_NEAR(transmitted(c), c * fresnel_transmittance(eta, c), 1e-7) << eta << " " << c;
    }
    EXPECT_EQ(transmitted(-0.1), 0.0);
    EXPECT_EQ(transmitted(1.1), transmitted(1.0));
  }
}

}  // namespace
}  // namespace scattermeter
