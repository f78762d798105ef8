// What all least-squares solves share.
#pragma once

namespace scattermeter {

// Where a solve stops: relative changes of the cost and of the parameters, largest gradient.
struct SolverStop {
  int iterations = 100;
  double function = 1e-12;
  double gradient = 1e-14;
  double parameter = 1e-12;
};

// Ceres's Solver::Options, as a parameter so that this header needs none of it: one thread, for the
// same digits on any machine, and not a word on the streams.
template <typename CeresOptions>
CeresOptions quiet_solver(const SolverStop& stop) {
  CeresOptions options;
  options.max_num_iterations = stop.iterations;
  options.function_tolerance = stop.function;
  options.gradient_tolerance = stop.gradient;
  options.parameter_tolerance = stop.parameter;
  options.num_threads = 1;
  options.logging_type = decltype(options.logging_type)::SILENT;
  return options;
}

}  // namespace scattermeter
