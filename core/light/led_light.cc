#include "core/light/led_light.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "core/base/covariance_root.h"
#include "core/base/tangents.h"

namespace scattermeter {
namespace {

constexpr double kExponentStep = 0.02;
constexpr double kTurn_rad = 0.01;

// The rows of the covariance that affect one channel: position, axis, exponent, its own intensity.
constexpr Eigen::Index kSeen = 7;

std::array<Eigen::Index, kSeen> seen_by(std::size_t channel) {
  return {0, 1, 2, 3, 4, 5, kLedLogIntensity + static_cast<Eigen::Index>(channel)};
}

// A nuisance whose last entry is the coefficient of the logarithm of the intensity.
LightNuisance calibrated_nuisance(const std::string& name, const Eigen::VectorXd& seen) {
  return {name, "LED calibration", 1.0, seen.head(kSeen - 1), seen[kSeen - 1], 0.0};
}

}  // namespace

std::vector<IncidentLight> LedLight::illuminate(const PatchMesh& patches, const RayScene& scene,
                                                double eta_int_over_ext, LightUse /*use*/) const {
  return {scattermeter::illuminate(patches, scene, led, eta_int_over_ext)};
}

std::unique_ptr<EntrySource> LedLight::entry(const RayScene& scene, double eta_int_over_ext,
                                             int /*channel*/) const {
  return led_entry(scene, led, eta_int_over_ext);
}

std::array<Eigen::Vector3d, 2> LedLight::across() const {
  return calibrated ? calibrated->tangents : tangents(about().axis);
}

Eigen::Vector3d LedLight::long_axis() const {
  return stated ? Eigen::Vector3d(led.axis / led.axis.dot(stated->axis)) : led.axis;
}

void LedLight::displace(const Eigen::VectorXd& by) {
  const Led from = about();
  const std::array<Eigen::Vector3d, 2> side = across();
  stated = from;
  led = from;
  Eigen::Index k = 0;
  for (int i = 0; i < 3 && moves(); ++i) led.position_mm[i] += by[k++];
  for (std::size_t t = 0; t < 2 && turns(); ++t) led.axis += by[k++] * side[t];
  led.axis.normalize();
  if (spreads()) led.exponent = std::max(0.0, led.exponent + by[k]);
}

Eigen::VectorXd LedLight::displacement() const {
  if (!stated) return {};
  std::vector<double> out;
  for (int i = 0; i < 3 && moves(); ++i) out.push_back((led.position_mm - stated->position_mm)[i]);
  for (std::size_t t = 0; t < 2 && turns(); ++t) {
    out.push_back((long_axis() - stated->axis).dot(across()[t]));
  }
  if (spreads()) out.push_back(led.exponent - stated->exponent);
  return Eigen::Map<const Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size()));
}

std::vector<LightChange> LedLight::changes(const Eigen::Vector3d& object_center_mm) const {
  std::vector<LightChange> out;
  const auto add = [&](const Led& other, double step) {
    auto changed = std::make_shared<LedLight>(*this);
    changed->led = other;
    out.push_back({std::move(changed), step});
  };
  // A hundredth of the distance: shadow edges then move by several of the parts that patches are
  // cut into, and the next order is still a hundredth of the first.
  const double move_mm = 0.01 * (led.position_mm - object_center_mm).norm();
  for (int i = 0; i < 3 && moves(); ++i) {
    Led other = led;
    other.position_mm[i] += move_mm;
    add(other, move_mm);
  }
  for (std::size_t t = 0; t < 2 && turns(); ++t) {
    Led other = led;
    other.axis = (long_axis() + kTurn_rad * across()[t]).normalized();
    add(other, kTurn_rad);
  }
  if (spreads()) {
    Led other = led;
    other.exponent += kExponentStep;
    add(other, kExponentStep);
  }
  return out;
}

// Columns of a calibrated LED are combinations of its parameters, so that what the calibration
// could not separate stays together (distance and power, say).
std::vector<LightNuisance> LedLight::nuisances(const std::string& name, std::size_t channel) const {
  std::vector<LightNuisance> out;
  if (calibrated) {
    const auto seen = seen_by(channel);
    const LedMatrix own =
        calibrated->covariance - calibrated->common * calibrated->common.transpose();
    const Eigen::MatrixXd root = covariance_root(own(seen, seen));
    for (Eigen::Index k = 0; k < root.cols(); ++k) {
      out.push_back(calibrated_nuisance(name + ".calibration" + std::to_string(k), root.col(k)));
    }
    if (!calibrated->common.isZero(0.0)) {
      out.push_back(calibrated_nuisance("white plane", calibrated->common(seen)));
    }
    return out;
  }
  const Eigen::Index n = (moves() ? 3 : 0) + (turns() ? 2 : 0) + (spreads() ? 1 : 0);
  for (Eigen::Index i = 0; i < 3 && moves(); ++i) {
    out.push_back({name + ".position" + std::to_string(i), "LED position", position_std_mm,
                   Eigen::VectorXd::Unit(n, i), 0.0, 0.0});
  }
  for (Eigen::Index i = 0; i < 2 && turns(); ++i) {
    out.push_back({name + ".axis" + std::to_string(i), "LED axis", axis_std_rad,
                   Eigen::VectorXd::Unit(n, (moves() ? 3 : 0) + i), 0.0, 0.0});
  }
  if (spreads()) {
    out.push_back({name + ".exponent", "LED exponent", exponent_std,
                   Eigen::VectorXd::Unit(n, n - 1), 0.0, 0.0});
  }
  if (intensity_relative_std > 0.0) {
    out.push_back({name + ".power", "LED power", intensity_relative_std, {}, 1.0, 0.0});
  }
  return out;
}

}  // namespace scattermeter
