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

// The view with too much influence on the lens, if any.
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

bool too_few_views(const ViewSelection& used, std::size_t n_given, CameraCalibration* out) {
  if (used.views.size() >= kMinViews || !used.fault.empty()) return false;
  refuse(out, CameraCalibrationStatus::kTooFewViews,
         (n_given == 0 ? "the board is found in no shot, and at least "
                       : std::to_string(used.views.size()) + " of " + std::to_string(n_given) +
                             " views can be used, and at least ") +
             std::to_string(kMinViews) +
             " views are needed (better ten): check the board's kind, squares and dictionary, and "
             "the shots");
  return true;
}

// The lens, its model and its uncertainty from the selected views; views with too much influence
// are moved to left_out, and the lens is chosen again without them.
class LensFit {
 public:
  LensFit(ViewSelection& used, const CameraCalibrationOptions& options, CameraCalibration* out)
      : used_(used), options_(options), out_(out), bundle_(used.bundle) {}

  // Leaves out at most `most_left_out` views. Fills model, intrinsics, layout and warnings; false
  // if too few of the `n_given` views are left.
  bool run(int width_px, int height_px, std::size_t most_left_out, std::size_t n_given) {
    for (std::size_t left_out = 0;; ++left_out) {
      choice_ = choose_lens(used_.views, width_px, height_px, bundle_, options_.model);
      bundle_ = choice_.bundle;
      out_->layout = camera_layout(used_.views, bundle_, width_px, height_px);
      out_->warnings = layout_warnings(out_->layout, used_.views.size());
      if (!choice_.chosen) return true;
      out_->model = choice_.candidates[*choice_.chosen].model;
      out_->intrinsics = intrinsics_of(bundle_.lens, width_px, height_px);
      uncertainty_ = lens_uncertainty(
          used_.views, equations_of(used_.views, bundle_, out_->intrinsics, out_->model),
          options_.board_std_mm);
      const auto bad =
          uncertainty_.determined && left_out < most_left_out ? puller(uncertainty_) : std::nullopt;
      if (!bad) return true;
      leave_out(*bad);
      if (too_few_views(used_, n_given, out_)) return false;
    }
  }

  const LensChoice& choice() const { return choice_; }
  const LensUncertainty& uncertainty() const { return uncertainty_; }
  const CameraBundle& bundle() const { return bundle_; }

 private:
  void leave_out(std::size_t view_idx) {
    const auto at = static_cast<std::ptrdiff_t>(view_idx);
    used_.left_out.push_back(
        {used_.views[view_idx].name,
         "it requires another lens than the other views (another camera, focal length or focus?)"});
    used_.views.erase(used_.views.begin() + at);
    bundle_.camera_from_board.erase(bundle_.camera_from_board.begin() + at);
  }

  ViewSelection& used_;
  const CameraCalibrationOptions& options_;
  CameraCalibration* out_;
  CameraBundle bundle_;
  LensChoice choice_;
  LensUncertainty uncertainty_;
};

// Largest standard deviation of the image of a fixed ray over the frame's four corners, px.
double frame_corner_std_px(const CameraCalibration& c) {
  const double right = c.intrinsics.width_px - 1, bottom = c.intrinsics.height_px - 1;
  double worst = 0;
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(right, 0), Eigen::Vector2d(0, bottom),
        Eigen::Vector2d(right, bottom)}) {
    const Eigen::MatrixXd j = image_shift_per_parameter(c.intrinsics, c.parameters, corner);
    worst = std::max(worst, std::sqrt((j * c.covariance * j.transpose()).trace()));
  }
  return worst;
}

// The calibration of the views in use: status kOk, or a refusal with its message.
void calibrate_selected(ViewSelection& used, int width_px, int height_px, std::size_t n_given,
                        const CameraCalibrationOptions& options, CameraCalibration* out) {
  if (!used.fault.empty()) {
    refuse(out, CameraCalibrationStatus::kNoConsensus, used.fault);
    return;
  }
  if (too_few_views(used, n_given, out)) return;
  LensFit fit(used, options, out);
  if (!fit.run(width_px, height_px, n_given / 4, n_given)) return;
  out->candidates = fit.choice().candidates;
  if (!fit.choice().chosen || !fit.uncertainty().determined) {
    refuse(out, CameraCalibrationStatus::kNotDetermined,
           with_warnings(
               "the views do not determine the lens (" +
                   (out->candidates.empty() ? std::string() : out->candidates.front().fault) + ")",
               out->warnings));
    return;
  }
  out->chosen = *fit.choice().chosen;
  out->parameters = parameter_names(out->model);
  out->covariance = fit.uncertainty().covariance;
  out->noise_std_px = fit.uncertainty().noise_std_px;
  out->view_scatter = fit.uncertainty().view_scatter;
  out->widened = fit.uncertainty().widened;
  const double focal_std = out->std(0) / out->value(0);
  if (!(focal_std <= kMaxFocalStd)) {
    std::ostringstream text;
    text.precision(2);
    text << "the views do not determine the focal length: it is known to " << 100 * focal_std
         << " % only, " << 100 * kMaxFocalStd << " % is the limit";
    refuse(out, CameraCalibrationStatus::kNotDetermined, with_warnings(text.str(), out->warnings));
    return;
  }
  out->status = CameraCalibrationStatus::kOk;
  fill_residuals(used, fit.bundle(), out);
  out->frame_corner_std_px = frame_corner_std_px(*out);
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
  calibrate_selected(used, width_px, height_px, views.size(), options, &out);
  out.left_out = used.left_out;
  out.corners_left_out = used.corners_left_out;
  return out;
}

}  // namespace scattermeter::calib
