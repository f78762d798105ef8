#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "apps/python/bindings.h"
#include "core/material/dipole.h"
#include "core/material/fresnel.h"
#include "core/material/half_space_albedo.h"

namespace py = pybind11;

namespace scattermeter::python {

// std::invalid_argument becomes ValueError.
void add_models(py::module_& module) {
  module.def(
      "dipole_reflectance",
      py::vectorize(
          [](double distance_mm, double sigma_s_prime_per_mm, double sigma_a_per_mm, double eta) {
            return scattermeter::Dipole({sigma_s_prime_per_mm, sigma_a_per_mm, eta})
                .reflectance_per_mm2(distance_mm);
          }),
      py::arg("distance_mm"), py::arg("sigma_s_prime_per_mm"), py::arg("sigma_a_per_mm"),
      py::arg("eta"),
      "Diffuse reflectance R(d) of a half-space by the dipole (Jensen et al. 2001), in 1/mm^2.\n\n"
      "distance_mm: between entry and exit, mm. sigma_s_prime_per_mm: reduced scattering, 1/mm, > "
      "0.\nsigma_a_per_mm: absorption, 1/mm, >= 0. eta: index inside over outside, > 0.\n"
      "ValueError outside of these.");
  module.def("dipole_total_reflectance",
             py::vectorize([](double sigma_s_prime_per_mm, double sigma_a_per_mm, double eta) {
               return scattermeter::Dipole({sigma_s_prime_per_mm, sigma_a_per_mm, eta})
                   .total_reflectance();
             }),
             py::arg("sigma_s_prime_per_mm"), py::arg("sigma_a_per_mm"), py::arg("eta"),
             "Integral of dipole_reflectance() over the plane: a share of what entered, 0 .. 1.");
  module.def("fresnel_transmittance", py::vectorize(scattermeter::fresnel_transmittance),
             py::arg("eta"), py::arg("cos_theta"),
             "Share of unpolarised light that a smooth boundary lets through from outside.\n\n"
             "eta: index behind the boundary over that in front, > 0. cos_theta: cosine to the "
             "normal in\nfront; 0 for 0 and less.");
  module.def("half_space_albedo",
             py::vectorize([](double albedo) { return scattermeter::half_space_albedo(albedo); }),
             py::arg("albedo"),
             "Share of diffuse light that an index-matched half-space of isotropic scatterers "
             "sends back\n(Chandrasekhar 1950).\n\nalbedo: sigma_s / sigma_t, 0 .. 1.");
}

}  // namespace scattermeter::python
