// The parts of the extension module.
#pragma once

#include <pybind11/pybind11.h>

namespace scattermeter::python {

// Forward models on NumPy arrays; arguments are broadcast against each other.
void add_models(pybind11::module_& module);
// The estimate from linear images as NumPy arrays, without files.
void add_estimate(pybind11::module_& module);

}  // namespace scattermeter::python
