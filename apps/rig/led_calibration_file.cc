#include "apps/rig/led_calibration_file.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "apps/rig/rig_fields.h"
#include "apps/rig/rig_led_lobe.h"
#include "apps/rig/yaml_field.h"
#include "core/base/symmetric_eigen.h"

namespace scattermeter::apps {
namespace {

constexpr int kDigits = 17;

template <typename Values>
void emit_row(YAML::Emitter& out, const Values& values) {
  out << YAML::Flow << YAML::BeginSeq;
  for (const double v : values) out << v;
  out << YAML::EndSeq;
}

// The map that read_lobe() reads.
void emit_lobe(YAML::Emitter& out, const LobeTable& lobe) {
  out << YAML::BeginMap << YAML::Key << "angle_deg" << YAML::Value;
  std::vector<double> angles_deg = lobe.angles_rad();
  for (double& a : angles_deg) a *= 180.0 / std::numbers::pi;
  emit_row(out, angles_deg);
  out << YAML::Key << (lobe.is_round() ? "relative" : "relative_x") << YAML::Value;
  emit_row(out, lobe.in_x());
  if (!lobe.is_round()) {
    out << YAML::Key << "relative_y" << YAML::Value;
    emit_row(out, lobe.in_y());
    out << YAML::Key << "x_axis" << YAML::Value;
    emit_row(out, lobe.x_axis());
  }
  out << YAML::EndMap;
}

void emit_residuals(YAML::Emitter& out, const calib::LedCalibration& c) {
  const calib::LedFit& fit = c.fit;
  out << YAML::Key << "residuals" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "highlight_rms_px" << YAML::Value << fit.highlight_rms_px;
  out << YAML::Key << "highlight_worst_px" << YAML::Value << fit.highlight_worst_px;
  out << YAML::Key << "plane_rms_percent" << YAML::Value << 100.0 * fit.plane_rms;
  out << YAML::Key << "plane_worst_percent" << YAML::Value << 100.0 * fit.plane_worst;
  out << YAML::Key << "highlights" << YAML::Value << YAML::BeginSeq;
  for (std::size_t i = 0; i < fit.highlight_residuals_px.size(); ++i) {
    const Eigen::Vector2d& r = fit.highlight_residuals_px[i];
    out << YAML::Flow << YAML::BeginMap << YAML::Key << "what" << YAML::Value
        << c.shots.highlight_names[i] << YAML::Key << "used" << YAML::Value
        << static_cast<bool>(fit.highlight_used[i]) << YAML::Key << "image_px" << YAML::Value;
    emit_row(out, c.shots.scene.highlights[i].image_px);
    out << YAML::Key << "predicted_minus_measured_px" << YAML::Value;
    emit_row(out, r);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::EndMap;
}

// The fitted ambient light relative to the LED's, by channel, of the shots with a fitted constant.
void emit_ambient(YAML::Emitter& out, const calib::LedCalibration& c) {
  if (c.fit.ambient.empty()) return;
  out << YAML::Key << "ambient" << YAML::Value << YAML::BeginSeq;
  for (const calib::FittedAmbient& a : c.fit.ambient) {
    out << YAML::BeginMap << YAML::Key << "file" << YAML::Value << c.shots.grids.at(a.shot).file
        << YAML::Key << "relative" << YAML::Value;
    emit_row(out, a.relative);
    out << YAML::Key << "relative_std" << YAML::Value;
    emit_row(out, a.relative_std);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq;
}

}  // namespace

std::string led_calibration_yaml(const calib::LedCalibration& c) {
  const calib::LedFit& fit = c.fit;
  if (fit.status != calib::LedStatus::kOk) {
    throw std::invalid_argument("led_calibration_yaml: the fit was refused");
  }
  YAML::Emitter out;
  out.SetDoublePrecision(kDigits);
  out << YAML::Comment("Made by scattermeter calibrate led; a rig takes it as lights." + c.light +
                       ".calibration");
  out << YAML::BeginMap;
  out << YAML::Key << "scattermeter_led" << YAML::Value << 1;
  out << YAML::Key << "light" << YAML::Value << c.light;
  out << YAML::Key << "position_mm" << YAML::Value;
  emit_row(out, fit.led.position_mm);
  out << YAML::Key << "axis" << YAML::Value;
  emit_row(out, fit.led.axis);
  out << YAML::Key << "exponent" << YAML::Value << fit.led.exponent;
  if (fit.led.table) {
    out << YAML::Comment("a correction to the table");
    out << YAML::Key << "lobe" << YAML::Value;
    emit_lobe(out, *fit.led.table);
  }
  out << YAML::Key << "radius_mm" << YAML::Value << fit.led.radius_mm;
  out << YAML::Key << "intensity_W_per_sr" << YAML::Value;
  emit_row(out, fit.led.intensity_W_per_sr);
  if (fit.lobe_fitted) {
    out << YAML::Comment("for the responsivity below: only their product counts");
    out << YAML::Key << "responsivity_counts_mm2_sr_per_W_s" << YAML::Value;
    emit_row(out, c.shots.responsivity);
    out << YAML::Key << "radiance_corrected" << YAML::Value << c.radiance_corrected;
    out << YAML::Comment("whether by camera.radiance, as the shots of objects then need to be");
  } else {
    out << YAML::Comment("the rig's, as no white plane was seen");
  }
  out << YAML::Key << "axis_tangents" << YAML::Value << YAML::Block << YAML::BeginSeq;
  for (const Eigen::Vector3d& t : fit.uncertainty.tangents) emit_row(out, t);
  out << YAML::EndSeq;
  out << YAML::Key << "covariance" << YAML::Value;
  out << YAML::Comment(
      "position x y z mm, axis along the tangents rad, exponent, ln intensity R G B");
  out << YAML::Block << YAML::BeginSeq;
  for (Eigen::Index i = 0; i < kLedParameters; ++i) {
    emit_row(out, Eigen::VectorXd(fit.uncertainty.covariance.row(i).transpose()));
  }
  out << YAML::EndSeq;
  out << YAML::Key << "common_to_plane" << YAML::Value;
  emit_row(out, fit.uncertainty.common);
  out << YAML::Comment("one deviation of the plane's albedo, part of the covariance");
  out << YAML::Key << "distance_mm" << YAML::Value << fit.distance_mm;
  out << YAML::Key << "distance_power_correlation" << YAML::Value << fit.distance_power_correlation;
  emit_ambient(out, c);
  emit_residuals(out, c);
  out << YAML::Key << "warnings" << YAML::Value << fit.warnings;
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

CalibratedLed read_led_calibration_file(const std::string& path) {
  const YamlField top = YamlField::load(path);
  top.only({"scattermeter_led", "light", "position_mm", "axis", "exponent", "lobe", "radius_mm",
            "intensity_W_per_sr", "responsivity_counts_mm2_sr_per_W_s", "radiance_corrected",
            "axis_tangents", "covariance", "common_to_plane", "distance_mm",
            "distance_power_correlation", "residuals", "warnings", "ambient"});
  require_version(top, "scattermeter_led", "LED calibrations");
  CalibratedLed out;
  Led& led = out.led;
  led.position_mm = top.at("position_mm").vector3();
  led.axis = unit_vector(top.at("axis"));
  if (const auto f = top.find("lobe")) led.table = read_lobe(*f, led.axis);
  led.exponent = top.at("exponent").number(led.least_exponent(), 1000.0);
  if (const auto f = top.find("radius_mm")) led.radius_mm = f->number(0.0, 1000.0);
  led.intensity_W_per_sr = some_light(top.at("intensity_W_per_sr"));
  if (const auto f = top.find("responsivity_counts_mm2_sr_per_W_s")) {
    out.responsivity = positive_rgb(*f);
  }
  if (const auto f = top.find("radiance_corrected")) out.radiance_corrected = f->boolean();

  LedUncertainty& u = out.uncertainty;
  const YamlField tangents = top.at("axis_tangents");
  const std::vector<YamlField> two = tangents.items();
  if (two.size() != 2) tangents.fail("expected two directions");
  for (std::size_t i = 0; i < 2; ++i) u.tangents[i] = unit_vector(two[i]);
  if (std::abs(u.tangents[0].dot(u.tangents[1])) > 1e-6 ||
      std::abs(u.tangents[0].dot(led.axis)) > 1e-6 ||
      std::abs(u.tangents[1].dot(led.axis)) > 1e-6) {
    tangents.fail("expected directions at right angles to the axis and to each other");
  }
  const YamlField covariance = top.at("covariance");
  const std::vector<YamlField> rows = covariance.items();
  if (rows.size() != static_cast<std::size_t>(kLedParameters)) {
    covariance.fail("expected 9 rows");
  }
  for (Eigen::Index i = 0; i < kLedParameters; ++i) {
    const std::vector<double> row = rows[static_cast<std::size_t>(i)].numbers(9);
    for (Eigen::Index k = 0; k < kLedParameters; ++k) {
      u.covariance(i, k) = row[static_cast<std::size_t>(k)];
    }
  }
  if (const auto f = top.find("common_to_plane")) {
    const std::vector<double> values = f->numbers(9);
    for (Eigen::Index i = 0; i < kLedParameters; ++i) {
      u.common[i] = values[static_cast<std::size_t>(i)];
    }
  }
  // Scaled to a unit diagonal, so that units have no influence.
  const LedVector scale = u.covariance.diagonal().cwiseMax(0.0).cwiseSqrt().unaryExpr(
      [](double std) { return std > 0.0 ? 1.0 / std : 0.0; });
  const LedMatrix own =
      scale.asDiagonal() * (u.covariance - u.common * u.common.transpose()) * scale.asDiagonal();
  if (!(own - own.transpose()).isZero(1e-9) || u.covariance.diagonal().minCoeff() < 0.0 ||
      !(symmetric_eigen(own).values[0] >= -1e-7)) {
    covariance.fail("expected a covariance: symmetric, without negative variances");
  }
  // Earlier files state one by spheres alone, too. The power from a plane goes with the distance.
  if (u.covariance.bottomLeftCorner<3, kLedLogIntensity>().isZero(0.0)) out.responsivity.reset();
  return out;
}

}  // namespace scattermeter::apps
