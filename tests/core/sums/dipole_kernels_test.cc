#include "core/sums/dipole_kernels.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/material/dipole.h"
#include "core/sums/dipole_pairs.h"

namespace scattermeter {
namespace {

constexpr Medium kKernelMedium{1.7, 0.01, 1.4};

KernelDipole kernel_dipole(const Medium& medium) {
  const Dipole d(medium);
  return {d.z_r_mm(), d.z_v_mm(), d.sigma_tr_per_mm()};
}

// Whatever vectors the processor has, the sums are those of core/material/dipole.h, in every lane,
// for every medium, and add to what stands there.
TEST(DipoleKernels, EveryInstructionSetGivesTheSame) {
  RowLanes rows;
  for (std::size_t i = 0; i < kRowLanes; ++i) {
    rows.x[i] = 100.0 + 0.3 * static_cast<double>(i);
    rows.y[i] = -50.0;
    rows.z[i] = 7.0;
  }
  const std::vector<float> x = {0.5F, -1.0F, 0.0F}, y = {0.0F, 0.25F, 2.0F}, z = {0.0F, 0.0F, 1.0F},
                           c = {1.0F, 0.5F, 0.25F};
  const KernelPoints points{{101.0, -50.5, 7.25}, x.data(), y.data(), z.data(), c.data(), 3};
  const std::vector<Medium> media = {kKernelMedium, {0.3, 0.1, 1.5}};
  std::vector<KernelDipole> kernels;
  for (const Medium& m : media) kernels.push_back(kernel_dipole(m));
  int sets = 0;
  for (const char* name : {"SSE4", "AVX2", "AVX3", ""}) {
    if (!choose_kernel_instruction_set(name)) continue;
    ++sets;
    if (*name != '\0') {
      EXPECT_EQ(kernel_instruction_set(), std::string(name));
    }
    std::vector<LaneSums> sums(2);
    sums[0].value[3] = 1000.0;
    add_point_sums(kernels, rows, {&points, 1}, 2.0, sums);
    for (std::size_t m = 0; m < media.size(); ++m) {
      const Dipole dipole(media[m]);
      for (std::size_t i = 0; i < kRowLanes; ++i) {
        double value = 0, d_s = 0, d_a = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const double dx = rows.x[i] - 101.0 - double(x[k]);
          const double dy = rows.y[i] + 50.5 - double(y[k]);
          const double dz = rows.z[i] - 7.25 - double(z[k]);
          const Dipole::Value v = dipole.with_derivatives(std::sqrt(dx * dx + dy * dy + dz * dz));
          value += 2.0 * double(c[k]) * v.r_per_mm2;
          d_s += 2.0 * double(c[k]) * v.d_sigma_s_prime;
          d_a += 2.0 * double(c[k]) * v.d_sigma_a;
        }
        const double before = m == 0 && i == 3 ? 1000.0 : 0.0;
        const DipoleSum got = dipole_sum(
            media[m], {sums[m].value[i] - before, sums[m].z_d_z[i], -0.5 * sums[m].decay[i]});
        EXPECT_NEAR(got.value, value, 2e-6 * value) << name << " lane " << i;
        // Terms of either sign: by z, by kappa^2, by alpha'.
        EXPECT_NEAR(got.per_sigma_a, d_a, 4e-6 * (std::abs(d_a) + value)) << name << " lane " << i;
        EXPECT_NEAR(got.per_sigma_s_prime, d_s, 4e-6 * (std::abs(d_s) + value))
            << name << " lane " << i;
      }
    }
  }
  EXPECT_GE(sets, 1);
  EXPECT_FALSE(choose_kernel_instruction_set("abacus"));
  EXPECT_TRUE(choose_kernel_instruction_set(""));
}

}  // namespace
}  // namespace scattermeter
