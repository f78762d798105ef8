#include "core/camera/lens_parameters.h"

#include <algorithm>
#include <stdexcept>

#include <Eigen/LU>

#include "core/base/covariance_root.h"
#include "core/camera/lens.h"

namespace scattermeter {
namespace {

constexpr const char* kNames[kLensParameters] = {"fx_px", "fy_px", "cx_px", "cy_px", "k1", "k2",
                                                 "p1",    "p2",    "k3",    "k4",    "k5", "k6"};

int distortion_terms(DistortionTerms terms) {
  switch (terms) {
    case DistortionTerms::kNone:
      return 0;
    case DistortionTerms::kK1:
      return 1;
    case DistortionTerms::kK1K2:
      return 2;
    case DistortionTerms::kK1K2P1P2:
      return 4;
    case DistortionTerms::kK1K2P1P2K3:
      return 5;
    case DistortionTerms::kRational:
      return 8;
  }
  throw std::invalid_argument("no such distortion");
}

}  // namespace

LensParameters lens_parameters(const CameraIntrinsics& intrinsics) {
  LensParameters lens = LensParameters::Zero();
  lens.head<4>() << intrinsics.fx_px, intrinsics.fy_px, intrinsics.cx_px, intrinsics.cy_px;
  for (std::size_t i = 0; i < intrinsics.distortion.size(); ++i) {
    lens[4 + static_cast<Eigen::Index>(i)] = intrinsics.distortion[i];
  }
  return lens;
}

CameraIntrinsics intrinsics_of(const LensParameters& lens, int width_px, int height_px) {
  CameraIntrinsics k;
  k.width_px = width_px;
  k.height_px = height_px;
  k.fx_px = lens[0];
  k.fy_px = lens[1];
  k.cx_px = lens[2];
  k.cy_px = lens[3];
  k.distortion.assign(lens.data() + 4, lens.data() + (lens.tail<3>().isZero(0) ? 9 : 12));
  return k;
}

Eigen::Matrix<double, 2, kLensParameters> shift_per_lens_parameter(const LensParameters& lens,
                                                                   const Eigen::Vector2d& ray) {
  const double x = ray.x();
  const double y = ray.y();
  const double s = ray.squaredNorm();
  const double numerator = 1 + s * (lens[4] + s * (lens[5] + s * lens[8]));
  const double denominator = 1 + s * (lens[9] + s * (lens[10] + s * lens[11]));
  const double c = numerator / denominator;
  const Eigen::Vector2d distorted(x * c + 2 * lens[6] * x * y + lens[7] * (s + 2 * x * x),
                                  y * c + lens[6] * (s + 2 * y * y) + 2 * lens[7] * x * y);
  const Eigen::Vector2d f(lens[0], lens[1]);
  const auto radial = [&](double dc) -> Eigen::Vector2d { return dc * f.cwiseProduct(ray); };
  Eigen::Matrix<double, 2, kLensParameters> j;
  j.col(0) << distorted.x(), 0;
  j.col(1) << 0, distorted.y();
  j.col(2) << 1, 0;
  j.col(3) << 0, 1;
  j.col(4) = radial(s / denominator);
  j.col(5) = radial(s * s / denominator);
  j.col(6) << f.x() * 2 * x * y, f.y() * (s + 2 * y * y);
  j.col(7) << f.x() * (s + 2 * x * x), f.y() * 2 * x * y;
  j.col(8) = radial(s * s * s / denominator);
  j.col(9) = radial(-c * s / denominator);
  j.col(10) = radial(-c * s * s / denominator);
  j.col(11) = radial(-c * s * s * s / denominator);
  return j;
}

std::vector<LensModel> all_lens_models() {
  std::vector<LensModel> models;
  for (const DistortionTerms terms :
       {DistortionTerms::kNone, DistortionTerms::kK1, DistortionTerms::kK1K2,
        DistortionTerms::kK1K2P1P2, DistortionTerms::kK1K2P1P2K3, DistortionTerms::kRational}) {
    for (const bool one : {true, false}) models.push_back({one, terms});
  }
  std::stable_sort(models.begin(), models.end(), [](const LensModel& a, const LensModel& b) {
    return parameter_names(a).size() < parameter_names(b).size();
  });
  return models;
}

std::string lens_model_name(const LensModel& model) {
  std::string name = model.one_focal_length ? "fx = fy, " : "fx and fy, ";
  const int n = distortion_terms(model.terms);
  if (n == 0) return name + "no distortion";
  for (int i = 0; i < n; ++i) {
    if (i > 0) name += ' ';
    name += kNames[4 + i];
  }
  return name;
}

std::vector<std::string> parameter_names(const LensModel& model) {
  std::vector<std::string> names = model.one_focal_length
                                       ? std::vector<std::string>{"f_px"}
                                       : std::vector<std::string>{kNames[0], kNames[1]};
  for (int i = 2; i < 4 + distortion_terms(model.terms); ++i) names.emplace_back(kNames[i]);
  return names;
}

Eigen::MatrixXd parameter_map(const LensModel& model) {
  const int rest = 2 + distortion_terms(model.terms);
  const int focal = model.one_focal_length ? 1 : 2;
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(kLensParameters, focal + rest);
  map(0, 0) = 1;
  map(1, focal - 1) = 1;
  map.block(2, focal, rest, rest).setIdentity();
  return map;
}

LensModel lens_model_of(const std::vector<std::string>& names) {
  for (const LensModel& model : all_lens_models()) {
    if (parameter_names(model) == names) return model;
  }
  std::string got;
  for (const std::string& name : names) got += " " + name;
  throw std::invalid_argument("no lens model has the parameters" + got);
}

Eigen::Matrix<double, 2, kLensParameters> ray_per_lens_parameter(const CameraIntrinsics& intrinsics,
                                                                 const Eigen::Vector2d& ray) {
  return ray_per_lens_parameter(Lens(intrinsics), lens_parameters(intrinsics), ray);
}

Eigen::Matrix<double, 2, kLensParameters> ray_per_lens_parameter(const Lens& lens,
                                                                 const LensParameters& parameters,
                                                                 const Eigen::Vector2d& ray) {
  Eigen::Matrix<double, 2, 3> by_point;
  lens.project(ray.homogeneous(), &by_point);
  return -by_point.leftCols<2>().inverse() * shift_per_lens_parameter(parameters, ray);
}

LensRoot lens_root(const std::vector<std::string>& parameters, const Eigen::MatrixXd& covariance) {
  if (covariance.size() == 0 || covariance.isZero(0.0)) return LensRoot(kLensParameters, 0);
  return parameter_map(lens_model_of(parameters)) * covariance_root(covariance);
}

LensRoot lens_root(const CameraIntrinsics& intrinsics, const LensDeviations& deviations) {
  LensRoot root(kLensParameters, 0);
  const auto add = [&](double std, const LensParameters& per_unit) {
    if (!(std >= 0.0)) throw std::invalid_argument("lens_root: negative deviation");
    if (std == 0.0) return;
    root.conservativeResize(Eigen::NoChange, root.cols() + 1);
    root.rightCols(1) = std * per_unit;
  };
  add(deviations.focal_length_relative,
      intrinsics.fx_px * LensParameters::Unit(0) + intrinsics.fy_px * LensParameters::Unit(1));
  add(deviations.aspect_relative, intrinsics.fy_px * LensParameters::Unit(1));
  add(deviations.centre_px, LensParameters::Unit(2));
  add(deviations.centre_px, LensParameters::Unit(3));
  add(deviations.k1, LensParameters::Unit(4));
  return root;
}

}  // namespace scattermeter
