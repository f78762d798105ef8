#include "apps/rig/rig_surroundings.h"

#include <array>
#include <optional>
#include <string>

#include "apps/rig/rig_fields.h"

namespace scattermeter::apps {
namespace {

// Of a plane whose albedo was estimated by eye or read from a data sheet.
constexpr double kAlbedoRelativeStd = 0.1;
constexpr double kLeastAlbedoStd = 0.02;

// One number for all channels, or R, G, B; 0 .. 1.
Eigen::Array3d read_shares(const YamlField& field) {
  if (field.is_scalar()) return Eigen::Array3d::Constant(field.number(0.0, 1.0));
  const Eigen::Array3d shares(rgb_not_negative(field).data());
  if (shares.maxCoeff() > 1.0) field.fail("expected numbers from 0 to 1");
  return shares;
}

PlaneContact read_contact(const YamlField& field) {
  const std::string name = field.text();
  if (name == "air") return PlaneContact::kAir;
  if (name == "optical") return PlaneContact::kOptical;
  if (name == "black") return PlaneContact::kBlack;
  field.fail("expected air, optical or black");
}

}  // namespace

SceneSurroundings read_surroundings(const YamlField& field) {
  field.only({"plane", "contact"});
  SceneSurroundings out;
  const YamlField given = field.at("plane");
  given.only({"z_mm", "albedo", "albedo_std"});
  ScenePlane& plane = out.plane.emplace();
  plane.line = given.line();
  plane.z_mm = given.at("z_mm").number();
  plane.albedo = read_shares(given.at("albedo"));
  plane.albedo_std = (kAlbedoRelativeStd * plane.albedo).max(kLeastAlbedoStd);
  if (const auto f = given.find("albedo_std")) plane.albedo_std = read_shares(*f);
  if (const auto f = field.find("contact")) plane.contact = read_contact(*f);
  return out;
}

}  // namespace scattermeter::apps
