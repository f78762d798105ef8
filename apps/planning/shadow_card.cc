#include "apps/planning/shadow_card.h"

#include <array>

#include <Eigen/Geometry>

namespace scattermeter::apps {
namespace {

constexpr double kFromMiddle = 0.6;   // of the object's diagonal: just outside
constexpr double kFarthest = 0.9;     // of the way to the lamp
constexpr double kHalfWidth = 1.5;    // of the diagonal
constexpr double kThickness = 0.005;  // of the diagonal

}  // namespace

std::unique_ptr<RayScene> with_shadow_card(const ObjectScene& object,
                                           const Eigen::Vector3d& lamp_mm, bool upright) {
  const double diagonal_mm = object.diagonal_mm();
  const Eigen::Vector3d to_lamp_mm = lamp_mm - object.box.center_mm();
  if (kFromMiddle * diagonal_mm > kFarthest * to_lamp_mm.norm()) return nullptr;
  const Eigen::Vector3d away = to_lamp_mm.normalized();
  // Along the edge, and from the edge over the card: (along, across, away) is right-handed.
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ() - away.z() * away;
  along = along.norm() > 1e-3 ? along.normalized() : away.unitOrthogonal();
  if (!upright) along = away.cross(along);
  const Eigen::Vector3d across = away.cross(along);
  TriangleMesh mesh = object.mesh();
  const auto first = static_cast<int>(mesh.vertices_mm.size());
  for (int i = 0; i < 8; ++i) {
    const double a = (i & 1) != 0 ? kHalfWidth : -kHalfWidth;
    const double b = (i & 2) != 0 ? kHalfWidth : 0.0;
    const double c = kFromMiddle + ((i & 4) != 0 ? kThickness : 0.0);
    mesh.vertices_mm.push_back(object.box.center_mm() +
                               diagonal_mm * (a * along + b * across + c * away));
  }
  constexpr std::array<std::array<int, 3>, 12> kBox = {{{0, 2, 1},
                                                        {1, 2, 3},
                                                        {4, 5, 6},
                                                        {5, 7, 6},
                                                        {0, 1, 4},
                                                        {1, 5, 4},
                                                        {2, 6, 3},
                                                        {3, 6, 7},
                                                        {0, 4, 2},
                                                        {2, 4, 6},
                                                        {1, 3, 5},
                                                        {3, 7, 5}}};
  for (const std::array<int, 3>& t : kBox) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return std::make_unique<RayScene>(mesh);
}

}  // namespace scattermeter::apps
