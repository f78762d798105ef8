#include "calib/lens/camera_calibration_file.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "calib/board/opencv_quiet.h"
#include "calib/board/opencv_storage.h"
#include "calib/lens/intrinsics_file.h"
#include "core/base/dense_solve.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

cv::Mat_<double> opencv_matrix(const Eigen::MatrixXd& m) {
  cv::Mat_<double> out(static_cast<int>(m.rows()), static_cast<int>(m.cols()));
  for (int r = 0; r < out.rows; ++r) {
    for (int c = 0; c < out.cols; ++c) out(r, c) = m(r, c);
  }
  return out;
}

double number_at(const std::string& path, const cv::FileNode& top, const char* name) {
  const cv::FileNode node = top[name];
  const double value = node.isReal() || node.isInt() ? static_cast<double>(node) : std::nan("");
  if (!(value >= 0) || !std::isfinite(value)) {
    throw InputError(path + ": scattermeter_camera." + name,
                     "expected a number that is not negative");
  }
  return value;
}

void read_covariance(const std::string& path, const cv::FileNode& top, CameraCalibrationFile* out) {
  for (const cv::FileNode& name : top["parameters"]) {
    out->parameters.push_back(name.isString() ? static_cast<std::string>(name) : "");
  }
  try {
    lens_model_of(out->parameters);
  } catch (const std::invalid_argument& error) {
    throw InputError(path + ": scattermeter_camera.parameters", error.what());
  }
  const std::string where = path + ": scattermeter_camera.covariance";
  const cv::Mat_<double> m(read_storage_matrix(where, top["covariance"]));
  const auto n = static_cast<int>(out->parameters.size());
  if (m.rows != n || m.cols != n) {
    throw InputError(where, "expected " + std::to_string(n) + " x " + std::to_string(n) +
                                ", a row for each parameter, got " + std::to_string(m.rows) +
                                " x " + std::to_string(m.cols));
  }
  out->covariance.resize(n, n);
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) out->covariance(r, c) = m(r, c);
  }
  const Eigen::VectorXd scale = out->covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation = scale.asDiagonal() * out->covariance * scale.asDiagonal();
  const bool good = correlation.allFinite() &&
                    (correlation - correlation.transpose()).cwiseAbs().maxCoeff() < 1e-9 &&
                    cholesky_lower(correlation).allFinite();
  if (!good) throw InputError(where, "expected a symmetric positive matrix of finite numbers");
}

void read_residuals(const std::string& path, const cv::FileNode& top, CameraCalibrationFile* out) {
  for (const cv::FileNode& view : top["views"]) {
    out->views.push_back(static_cast<std::string>(view["name"]));
  }
  const std::string where = path + ": scattermeter_camera.residuals";
  const cv::Mat_<double> m(read_storage_matrix(where, top["residuals"]));
  if (m.cols != 5) throw InputError(where, "expected 5 columns, got " + std::to_string(m.cols));
  for (int r = 0; r < m.rows; ++r) {
    const double view = m(r, 0);
    if (!(view >= 0 && view < static_cast<double>(out->views.size())) || view != std::floor(view)) {
      throw InputError(where, "row " + std::to_string(r + 1) +
                                  " refers to an unknown view: " + std::to_string(view));
    }
    out->residuals.push_back(
        {static_cast<std::size_t>(view), {m(r, 1), m(r, 2)}, {m(r, 3), m(r, 4)}});
  }
}

void write_names(cv::FileStorage& out, const char* key, const std::vector<std::string>& names) {
  out << key << "[";
  for (const std::string& name : names) out << name;
  out << "]";
}

void write_views(cv::FileStorage& out, const CameraCalibration& calibration) {
  out << "views"
      << "[";
  for (const CalibratedView& view : calibration.views) {
    out << "{"
        << "name" << view.name << "corners" << static_cast<int>(view.n_corners) << "rms_px"
        << view.rms_px << "worst_px" << view.worst_px << "}";
  }
  out << "]"
      << "left_out"
      << "[";
  for (const LeftOutView& view : calibration.left_out) {
    out << "{"
        << "name" << view.name << "reason" << view.reason << "}";
  }
  out << "]"
      << "corners_left_out"
      << "[";
  for (const LeftOutCorner& corner : calibration.corners_left_out) {
    out << "{"
        << "view" << corner.view << "x_px" << corner.image_px.x() << "y_px" << corner.image_px.y()
        << "distance_px" << corner.distance_px << "}";
  }
  out << "]";
}

void write_candidates(cv::FileStorage& out, const CameraCalibration& calibration) {
  out << "models"
      << "[";
  for (std::size_t i = 0; i < calibration.candidates.size(); ++i) {
    const LensCandidate& c = calibration.candidates[i];
    out << "{"
        << "name" << lens_model_name(c.model);
    if (c.fault.empty()) {
      out << "rms_px" << c.rms_px << "left_out_rms_px" << c.left_out_rms_px << "chosen"
          << static_cast<int>(i == calibration.chosen);
    } else {
      out << "fault" << c.fault;
    }
    out << "}";
  }
  out << "]";
}

void write_residuals(cv::FileStorage& out, const std::vector<CornerResidual>& corners) {
  cv::Mat_<double> residuals(static_cast<int>(corners.size()), 5);
  for (int i = 0; i < residuals.rows; ++i) {
    const CornerResidual& r = corners[static_cast<std::size_t>(i)];
    residuals(i, 0) = static_cast<double>(r.view_idx);
    residuals(i, 1) = r.image_px.x();
    residuals(i, 2) = r.image_px.y();
    residuals(i, 3) = r.residual_px.x();
    residuals(i, 4) = r.residual_px.y();
  }
  out << "residuals" << residuals;
}

}  // namespace

std::string camera_calibration_text(const CameraCalibration& calibration,
                                    const std::vector<std::string>& comments) {
  if (calibration.status != CameraCalibrationStatus::kOk) {
    throw std::invalid_argument("camera_calibration_text: the calibration was refused");
  }
  const CameraIntrinsics& k = calibration.intrinsics;
  cv::FileStorage out(
      ".yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  for (const std::string& comment : comments) out.writeComment(comment);
  out << "image_width" << k.width_px << "image_height" << k.height_px;
  out << "camera_matrix" << cv::Mat(cv::Matx33d(k.fx_px, 0, k.cx_px, 0, k.fy_px, k.cy_px, 0, 0, 1));
  out << "distortion_coefficients" << cv::Mat(k.distortion, true);
  out << "avg_reprojection_error" << calibration.rms_px;
  out << "scattermeter_camera"
      << "{"
      << "version" << 1;
  write_names(out, "parameters", calibration.parameters);
  out << "covariance" << opencv_matrix(calibration.covariance);
  out << "rms_px" << calibration.rms_px << "worst_px" << calibration.worst_px;
  out << "noise_std_px" << calibration.noise_std_px;
  out << "view_scatter" << calibration.view_scatter;
  out << "covariance_widened" << static_cast<int>(calibration.widened);
  out << "frame_corner_std_px" << calibration.frame_corner_std_px;
  out << "widest_angle_rad" << calibration.layout.widest_angle_rad;
  out << "covered_share" << calibration.layout.covered_share;
  write_views(out, calibration);
  write_candidates(out, calibration);
  write_names(out, "warnings", calibration.warnings);
  write_residuals(out, calibration.residuals);
  out << "}";
  return out.releaseAndGetString();
}

CameraCalibrationFile read_camera_calibration_file(const std::string& path) {
  CameraCalibrationFile out;
  out.intrinsics = read_intrinsics(path);
  const OpencvQuiet quiet;
  try {
    const cv::FileStorage storage = open_storage(path);
    const cv::FileNode top = storage["scattermeter_camera"];
    if (top.empty()) return out;
    if (!top.isMap() || static_cast<int>(top["version"]) != 1) {
      throw InputError(path + ": scattermeter_camera.version", "this program reads version 1");
    }
    read_covariance(path, top, &out);
    out.rms_px = number_at(path, top, "rms_px");
    out.worst_px = number_at(path, top, "worst_px");
    out.noise_std_px = number_at(path, top, "noise_std_px");
    read_residuals(path, top, &out);
  } catch (const cv::Exception& error) {
    throw InputError(path, "cannot be read: " + error.err);
  }
  return out;
}

}  // namespace scattermeter::calib
