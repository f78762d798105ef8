// Means over independent blocks of paths, with their standard error.
#pragma once

#include <cmath>

namespace scattermeter::test_support {

struct BlockMean {
  double sum = 0, squares = 0;
  int n = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
    ++n;
  }
  double mean() const { return sum / n; }
  double std_error() const { return std::sqrt((squares / n - mean() * mean()) / (n - 1)); }
  // Standard errors between the mean and an expected value.
  double z(double expected) const { return (mean() - expected) / std_error(); }
};

// Of two-sided tests: a normal variable passes it once in 15,000 times. Tests are seeded, so what
// passes once passes always.
constexpr double kSigmas = 4.0;

}  // namespace scattermeter::test_support
