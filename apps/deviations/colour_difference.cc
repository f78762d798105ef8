#include "apps/deviations/colour_difference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scattermeter::apps {
namespace {

constexpr double kPi = std::numbers::pi;

// The hue of an achromatic colour is 0.
double hue_rad(double a, double b) {
  if (a == 0.0 && b == 0.0) return 0.0;
  const double h = std::atan2(b, a);
  return h < 0.0 ? h + 2.0 * kPi : h;
}

double degrees(double deg) { return deg * kPi / 180.0; }

double saturation_of_chroma(double chroma) {
  const double c7 = std::pow(chroma, 7);
  return std::sqrt(c7 / (c7 + std::pow(25.0, 7)));
}

// Mean of two hues, the shorter way round; their sum if one of the colours is achromatic.
double mean_hue(double h1, double h2, bool achromatic) {
  if (achromatic) return h1 + h2;
  if (std::abs(h1 - h2) <= kPi) return 0.5 * (h1 + h2);
  return h1 + h2 < 2.0 * kPi ? 0.5 * (h1 + h2) + kPi : 0.5 * (h1 + h2) - kPi;
}

}  // namespace

Eigen::Vector3d lab_from_linear_srgb(const Eigen::Vector3d& rgb) {
  // X, Y, Z over those of the white.
  Eigen::Matrix3d xyz_from_rgb;
  xyz_from_rgb << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Eigen::Vector3d white = xyz_from_rgb * Eigen::Vector3d::Ones();
  const Eigen::Vector3d xyz = (xyz_from_rgb * rgb.cwiseMax(0.0)).cwiseQuotient(white);
  const auto f = [](double t) {
    constexpr double kLinearBelow = 216.0 / 24389.0;
    return t > kLinearBelow ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  };
  return {116.0 * f(xyz[1]) - 16.0, 500.0 * (f(xyz[0]) - f(xyz[1])),
          200.0 * (f(xyz[1]) - f(xyz[2]))};
}

double ciede2000(const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2) {
  const double mean_chroma = 0.5 * (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2]));
  const double stretch = 1.0 + 0.5 * (1.0 - saturation_of_chroma(mean_chroma));
  const double a1 = stretch * lab1[1], a2 = stretch * lab2[1];
  const double c1 = std::hypot(a1, lab1[2]), c2 = std::hypot(a2, lab2[2]);
  const double h1 = hue_rad(a1, lab1[2]), h2 = hue_rad(a2, lab2[2]);
  const bool achromatic = c1 * c2 == 0.0;

  const double dl = lab2[0] - lab1[0];
  const double dc = c2 - c1;
  double dh = achromatic ? 0.0 : h2 - h1;
  if (dh > kPi) dh -= 2.0 * kPi;
  if (dh < -kPi) dh += 2.0 * kPi;
  const double dh_metric = 2.0 * std::sqrt(c1 * c2) * std::sin(0.5 * dh);

  const double l = 0.5 * (lab1[0] + lab2[0]);
  const double c = 0.5 * (c1 + c2);
  const double h = mean_hue(h1, h2, achromatic);
  const double t = 1.0 - 0.17 * std::cos(h - degrees(30.0)) + 0.24 * std::cos(2.0 * h) +
                   0.32 * std::cos(3.0 * h + degrees(6.0)) -
                   0.20 * std::cos(4.0 * h - degrees(63.0));
  const double l50 = (l - 50.0) * (l - 50.0);
  const double sl = 1.0 + 0.015 * l50 / std::sqrt(20.0 + l50);
  const double sc = 1.0 + 0.045 * c;
  const double sh = 1.0 + 0.015 * c * t;
  const double from_blue = (h - degrees(275.0)) / degrees(25.0);
  const double turn = degrees(60.0) * std::exp(-from_blue * from_blue);
  const double rt = -std::sin(turn) * 2.0 * saturation_of_chroma(c);
  const double l_part = dl / sl, c_part = dc / sc, h_part = dh_metric / sh;
  return std::sqrt(
      std::max(0.0, l_part * l_part + c_part * c_part + h_part * h_part + rt * c_part * h_part));
}

}  // namespace scattermeter::apps
