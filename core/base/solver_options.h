// Options shared by all least-squares solvers.
#pragma once

namespace scattermeter {

// Stopping criteria: relative changes of the cost and of the parameters, largest gradient
// component.
struct SolverStop {
  int iterations = 100;
  double function = 1e-12;
  double gradient = 1e-14;
  double parameter = 1e-12;
};

// Ceres's Solver::Options, a template parameter so that this header does not include Ceres: one
// thread, for identical digits on any machine, and no output.
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
