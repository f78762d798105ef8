// Values of the dictionaries that `estimate` takes, by key.
#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "core/base/input_error.h"

namespace scattermeter::python {

// Throws InputError naming where.key if the value is missing or of another kind.
template <class T>
T field(const pybind11::dict& dict, const std::string& where, const char* key) {
  if (!dict.contains(key)) throw InputError(where + "." + key, "is missing");
  try {
    return dict[key].cast<T>();
  } catch (const pybind11::cast_error&) {
    throw InputError(where + "." + key,
                     "is of another kind than expected: " + std::string(pybind11::str(dict[key])));
  }
}

// `otherwise` where it is missing or None.
template <class T>
T field(const pybind11::dict& dict, const std::string& where, const char* key, T otherwise) {
  if (!dict.contains(key) || dict[key].is_none()) return otherwise;
  return field<T>(dict, where, key);
}

// A standard deviation; 0: exact. Throws InputError if it is negative.
inline double deviation(const pybind11::dict& dict, const std::string& where, const char* key,
                        double otherwise) {
  const double std = field<double>(dict, where, key, otherwise);
  if (!(std >= 0.0)) throw InputError(where + "." + key, "expected a number that is not negative");
  return std;
}

}  // namespace scattermeter::python
