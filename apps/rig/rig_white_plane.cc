#include "apps/rig/rig_white_plane.h"

#include <array>
#include <cmath>

#include "apps/rig/rig_fields.h"

namespace scattermeter::apps {

calib::WhitePlane read_white_plane(const YamlField& field, double default_albedo_relative_std) {
  calib::WhitePlane plane;
  if (const auto f = field.find("origin_mm")) plane.origin_mm = f->vector3();
  if (const auto f = field.find("x_axis")) plane.x_axis = unit_vector(*f);
  if (const auto f = field.find("y_axis")) plane.y_axis = unit_vector(*f);
  if (std::abs(plane.x_axis.dot(plane.y_axis)) > 1e-6) {
    field.fail("x_axis and y_axis are not at right angles");
  }
  const YamlField size = field.at("size_mm");
  size.numbers(2);
  plane.width_mm = size.items()[0].positive();
  plane.height_mm = size.items()[1].positive();
  const YamlField albedo = field.at("albedo");
  plane.albedo = Eigen::Array3d(positive_rgb(albedo).data());
  if (plane.albedo.maxCoeff() > 1.0) albedo.fail("expected albedos of at most 1");
  plane.albedo_relative_std = default_albedo_relative_std;
  if (const auto f = field.find("albedo_relative_std")) {
    plane.albedo_relative_std = f->number(0.0, 1.0);
  }
  return plane;
}

}  // namespace scattermeter::apps
