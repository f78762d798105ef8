#include "calib/lens/camera_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

#include "calib/lens/lens_uncertainty.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

constexpr std::size_t kMinViews = 3;
constexpr double kMaxFocalStd = 0.02;
constexpr double kInfluence = 15;
constexpr std::size_t kMinViewsForInfluence = 6;

void check_input(const std::vector<BoardView>& views, int width_px, int height_px) {
  if (width_px <= 0 || height_px <= 0) {
    throw std::invalid_argument("calibrate_camera: size must be positive, got " +
                                std::to_string(width_px) + " x " + std::to_string(height_px));
  }
  std::set<std::string> names;
  for (const BoardView& view : views) {
    if (!names.insert(view.name).second) {
      throw std::invalid_argument("calibrate_camera: two views named " + view.name);
    }
    for (const PointPair& c : view.corners) {
      if (!c.world_mm.allFinite() || !c.image_px.allFinite()) {
        throw std::invalid_argument("calibrate_camera: a corner of " + view.name +
                                    " is not finite");
      }
    }
  }
}

std::vector<ViewEquations> equations_of(const std::vector<BoardView>& views,
                                        const CameraBundle& bundle, const CameraIntrinsics& k,
                                        const LensModel& model) {
  std::vector<ViewEquations> out;
  for (std::size_t i = 0; i < views.size(); ++i) {
    out.push_back(view_equations(views[i], bundle.camera_from_board[i], k, model));
  }
  return out;
}

// The view that pulls too hard, if any.
std::optional<std::size_t> puller(const LensUncertainty& u) {
  if (u.scatter_of_view.size() < kMinViewsForInfluence) return std::nullopt;
  std::vector<double> sorted = u.scatter_of_view;
  std::sort(sorted.begin(), sorted.end());
  const auto worst = std::max_element(u.scatter_of_view.begin(), u.scatter_of_view.end());
  if (!(*worst > kInfluence * std::max(0.5, sorted[sorted.size() / 2]))) return std::nullopt;
  return static_cast<std::size_t>(worst - u.scatter_of_view.begin());
}

void refuse(CameraCalibration* out, CameraCalibrationStatus status, const std::string& message) {
  out->status = status;
  out->message = message;
}

std::string with_warnings(std::string message, const std::vector<std::string>& warnings) {
  for (const std::string& w : warnings) message += "; " + w;
  return message;
}

void fill_residuals(const ViewSelection& used, const CameraBundle& bundle, CameraCalibration* out) {
  double sum = 0;
  for (std::size_t i = 0; i < used.views.size(); ++i) {
    const BoardView& view = used.views[i];
    const std::vector<Eigen::Vector2d> r =
        view_residuals(view, bundle.camera_from_board[i], out->intrinsics);
    CalibratedView summary{view.name, r.size(), 0, 0};
    double view_sum = 0;
    for (std::size_t c = 0; c < r.size(); ++c) {
      out->residuals.push_back({i, view.corners[c].image_px, r[c]});
      view_sum += r[c].squaredNorm();
      summary.worst_px = std::max(summary.worst_px, r[c].norm());
    }
    summary.rms_px = std::sqrt(view_sum / static_cast<double>(r.size()));
    out->worst_px = std::max(out->worst_px, summary.worst_px);
    sum += view_sum;
    out->views.push_back(summary);
  }
  out->rms_px = std::sqrt(sum / static_cast<double>(out->residuals.size()));
}

}  // namespace

void CameraCalibrationOptions::Check() const {
  if (!(board_std_mm >= 0) || !std::isfinite(board_std_mm)) {
    throw std::invalid_argument("board_std_mm must be finite and not negative, got " +
                                std::to_string(board_std_mm));
  }
}

double CameraCalibration::value(std::size_t parameter_idx) const {
  const LensParameters lens = lens_parameters(intrinsics);
  const Eigen::MatrixXd map = parameter_map(model);
  Eigen::Index row = 0;
  map.col(static_cast<Eigen::Index>(parameter_idx)).maxCoeff(&row);
  return lens[row];
}

double CameraCalibration::std(std::size_t parameter_idx) const {
  const auto i = static_cast<Eigen::Index>(parameter_idx);
  return std::sqrt(covariance(i, i));
}

Eigen::MatrixXd image_shift_per_parameter(const CameraIntrinsics& intrinsics,
                                          const std::vector<std::string>& parameters,
                                          const Eigen::Vector2d& pixel) {
  const Eigen::MatrixXd map = parameter_map(lens_model_of(parameters));
  const Eigen::Vector2d ray = Lens(intrinsics).unproject(pixel);
  if (!ray.allFinite()) {
    return Eigen::MatrixXd::Constant(2, map.cols(), std::numeric_limits<double>::quiet_NaN());
  }
  return shift_per_lens_parameter(lens_parameters(intrinsics), ray) * map;
}

CameraCalibration calibrate_camera(const std::vector<BoardView>& views, int width_px, int height_px,
                                   const CameraCalibrationOptions& options) {
  options.Check();
  check_input(views, width_px, height_px);
  CameraCalibration out;
  ViewSelection used = select_views(views, width_px, height_px);
  const auto too_few = [&] {
    if (used.views.size() >= kMinViews || !used.fault.empty()) return false;
    refuse(&out, CameraCalibrationStatus::kTooFewViews,
           std::to_string(used.views.size()) + " of " + std::to_string(views.size()) +
               " views can be used, at least " + std::to_string(kMinViews) +
               " are needed (better ten): check the board's kind, squares and dictionary, and the "
               "shots");
    return true;
  };
  const auto end = [&]() -> CameraCalibration& {
    out.left_out = used.left_out;
    out.corners_left_out = used.corners_left_out;
    return out;
  };
  if (!used.fault.empty()) {
    refuse(&out, CameraCalibrationStatus::kNoConsensus, used.fault);
    return end();
  }
  if (too_few()) return end();

  CameraBundle bundle = used.bundle;
  LensChoice choice;
  LensUncertainty uncertainty;
  const std::size_t most_left_out = views.size() / 4;
  for (std::size_t left_out = 0;; ++left_out) {
    choice = choose_lens(used.views, width_px, height_px, bundle, options.model);
    bundle = choice.bundle;
    out.layout = camera_layout(used.views, bundle, width_px, height_px);
    out.warnings = layout_warnings(out.layout, used.views.size());
    if (!choice.chosen) break;
    out.model = choice.candidates[*choice.chosen].model;
    out.intrinsics = intrinsics_of(bundle.lens, width_px, height_px);
    uncertainty =
        lens_uncertainty(used.views, equations_of(used.views, bundle, out.intrinsics, out.model),
                         options.board_std_mm);
    const auto bad =
        uncertainty.determined && left_out < most_left_out ? puller(uncertainty) : std::nullopt;
    if (!bad) break;
    const auto at = static_cast<std::ptrdiff_t>(*bad);
    used.left_out.push_back({used.views[*bad].name,
                             "it asks for another lens than the other views do (another camera, "
                             "focal length or focus?)"});
    used.views.erase(used.views.begin() + at);
    bundle.camera_from_board.erase(bundle.camera_from_board.begin() + at);
    if (too_few()) return end();
  }
  out.candidates = choice.candidates;
  if (!choice.chosen || !uncertainty.determined) {
    refuse(
        &out, CameraCalibrationStatus::kNotDetermined,
        with_warnings(
            "the views do not determine the lens (" +
                (choice.candidates.empty() ? std::string() : choice.candidates.front().fault) + ")",
            out.warnings));
    return end();
  }
  out.chosen = *choice.chosen;
  out.parameters = parameter_names(out.model);
  out.covariance = uncertainty.covariance;
  out.noise_std_px = uncertainty.noise_std_px;
  out.view_scatter = uncertainty.view_scatter;
  out.widened = uncertainty.widened;
  const double focal_std = out.std(0) / out.value(0);
  if (!(focal_std <= kMaxFocalStd)) {
    std::ostringstream text;
    text.precision(2);
    text << "the views do not determine the focal length: it is known to " << 100 * focal_std
         << " % only, " << 100 * kMaxFocalStd << " % is the limit";
    refuse(&out, CameraCalibrationStatus::kNotDetermined, with_warnings(text.str(), out.warnings));
    return end();
  }
  out.status = CameraCalibrationStatus::kOk;
  fill_residuals(used, bundle, &out);
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(width_px - 1, 0), Eigen::Vector2d(0, height_px - 1),
        Eigen::Vector2d(width_px - 1, height_px - 1)}) {
    const Eigen::MatrixXd j = image_shift_per_parameter(out.intrinsics, out.parameters, corner);
    out.frame_corner_std_px =
        std::max(out.frame_corner_std_px, std::sqrt((j * out.covariance * j.transpose()).trace()));
  }
  return end();
}

}  // namespace scattermeter::calib
