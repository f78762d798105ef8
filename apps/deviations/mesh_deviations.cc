// The piece has another place, size or shape than its mesh.
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "apps/deviations/cut_mesh.h"
#include "apps/deviations/deviation.h"
#include "core/mesh/bodies.h"
#include "core/mesh/round_bodies.h"

namespace scattermeter::apps {
namespace {

const std::vector<std::string> kMeshWords = {"mesh", "outline", "silhouette", "pose", "place"};

void transform(TriangleMesh& mesh, const Eigen::Matrix3d& about_centre,
               const Eigen::Vector3d& shift_mm = Eigen::Vector3d::Zero()) {
  const Eigen::Vector3d centre_mm = bounds(mesh).center_mm();
  for (Eigen::Vector3d& v : mesh.vertices_mm) {
    v = centre_mm + about_centre * (v - centre_mm) + shift_mm;
  }
}

Eigen::Matrix3d turned(double degrees, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis).toRotationMatrix();
}

Deviation displaced(const char* name, const Eigen::Vector3d& direction) {
  return {.name = name,
          .words = kMeshWords,
          .unit = "mm",
          .sizes = {0.1, 1, 3},
          .within = 1,
          .truth = [direction](TrueSetup& t, const DeviationDraw& d) {
            transform(t.mesh, Eigen::Matrix3d::Identity(), d.signed_size() * direction);
          }};
}

Deviation rotated(const char* name, const Eigen::Vector3d& axis) {
  return {.name = name,
          .words = kMeshWords,
          .unit = "deg",
          .sizes = {0.3, 2, 10},
          .within = 1,
          .truth = [axis](TrueSetup& t, const DeviationDraw& d) {
            transform(t.mesh, turned(d.signed_size(), axis));
          }};
}

Deviation stretched(const char* name, const Eigen::Vector3d& axes) {
  return {.name = name,
          .words = {"mesh", "outline", "silhouette", "size", "scale"},
          .unit = "%",
          .sizes = {0.2, 1, 5},
          .within = 1,
          .truth = [axes](TrueSetup& t, const DeviationDraw& d) {
            const Eigen::Vector3d factor = Eigen::Vector3d::Ones() + 0.01 * d.signed_size() * axes;
            transform(t.mesh, factor.asDiagonal());
          }};
}

// Opposite changes of two sides, so that the volume stays.
void reshape(TrueSetup& t, const DeviationDraw& d) {
  const double factor = 1.0 + 0.01 * d.size;
  const Eigen::Vector3d factors = d.sign > 0.0 ? Eigen::Vector3d(factor, 1.0 / factor, 1.0)
                                               : Eigen::Vector3d(1.0 / factor, 1.0, factor);
  transform(t.mesh, factors.asDiagonal());
}

// Round for what has edges, a cube for a sphere.
void exchange_body(TrueSetup& t, const DeviationDraw&) {
  t.mesh = t.mesh.triangles.size() > 100 ? cube_mesh() : sphere_mesh();
}

}  // namespace

std::vector<Deviation> mesh_deviations() {
  const std::vector<std::string> shape = {"mesh", "outline", "silhouette", "shape", "edge"};
  return {
      displaced("mesh displaced in x", Eigen::Vector3d::UnitX()),
      displaced("mesh displaced in y", Eigen::Vector3d::UnitY()),
      displaced("mesh displaced in z", Eigen::Vector3d::UnitZ()),
      rotated("mesh turned about z", Eigen::Vector3d::UnitZ()),
      rotated("mesh turned about x", Eigen::Vector3d::UnitX()),
      stretched("mesh scaled", Eigen::Vector3d::Ones()),
      stretched("mesh stretched in x", Eigen::Vector3d::UnitX()),
      stretched("mesh stretched in z", Eigen::Vector3d::UnitZ()),
      {.name = "other proportions",
       .words = shape,
       .unit = "%",
       .sizes = {2, 5, 15},
       .truth = reshape},
      {.name = "another body", .words = shape, .unit = "", .sizes = {1}, .truth = exchange_body},
      {.name = "corner chipped off",
       .words = shape,
       .unit = "mm",
       .sizes = {0.5, 2, 5},
       .truth =
           [](TrueSetup& t, const DeviationDraw& d) {
             t.mesh = chipped_mesh(t.mesh, Eigen::Vector3d(0.4, -0.5, 0.77).normalized(), d.size);
           }},
      {.name = "edges bevelled",
       .words = {"edge", "chamfer", "bevel", "mesh"},
       .unit = "mm",
       .sizes = {0.1, 0.4, 1.5},
       .within = 1,
       .needs = {.edges = true},
       .truth = [](TrueSetup& t,
                   const DeviationDraw& d) { t.mesh = bevelled_mesh(t.mesh, d.size); }},
  };
}

}  // namespace scattermeter::apps
