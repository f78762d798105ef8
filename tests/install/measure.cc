// Measures a folder of shots with a rig and prints the table: measure RIG SHOTS.
#include "apps/instrument/measure.h"

#include <cstdio>

#include "core/base/input_error.h"

int main(int, char** arguments) try {
  using namespace scattermeter;
  const apps::Measurement m = apps::measure(apps::read_rig(arguments[1]), arguments[2]);
  for (const ChannelResult& r : m.results) {
    const Quantity& s = r.estimate.sigma_s_prime_per_mm;
    const Quantity& a = r.estimate.sigma_a_per_mm;
    std::printf("%-6s %c %.5f +- %.5f %.7f +- %.7f %s\n", r.material.c_str(), r.channel, s.value,
                s.std, a.value, a.std, r.refused() ? "refused" : "ok");
  }
  return m.any_refused() ? 1 : 0;
} catch (const scattermeter::InputError& e) {
  return std::fprintf(stderr, "%s\n", e.what()), 2;
}
