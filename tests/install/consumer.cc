// Prints what half-spaces of a material send back: by the dipole, and, index-matched, exactly; and
// how many rays down on a tetrahedron meet it (Embree comes along).
#include <cstdio>

#include "core/material/dipole.h"
#include "core/material/half_space_albedo.h"
#include "core/mesh/ray_scene.h"

int main() {
  const scattermeter::Medium medium{2.19, 0.002, 1.3};
  const double albedo = medium.sigma_s_prime_per_mm / medium.sigma_t_prime_per_mm();
  scattermeter::TriangleMesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const scattermeter::RayScene scene(mesh);
  std::printf("%.6f %.6f %zu\n", scattermeter::Dipole(medium).total_reflectance(),
              scattermeter::half_space_albedo(albedo), scene.mesh().triangles.size());
}
