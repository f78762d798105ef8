#include "calib/pose/outline_causes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/core.h>

#include "core/base/chi_square.h"
#include "core/base/symmetric_eigen.h"

namespace scattermeter::calib {
namespace {

constexpr double kOutlineDoubt = 1e-4;
constexpr double kOutlineCloseScore = 6.0;
constexpr double kGrowth = 0.5;     // cells
constexpr double kShotShift = 0.3;  // cells
// An object is put down in another place far more often than its mesh is turned or of another size:
// by this much the latter must be more likely, as a score.
constexpr double kRare = 5.0;
constexpr Eigen::Index kOutlinePose = OutlineModel::kPose;

// Length of a vector and its standard deviation along itself.
std::pair<double, double> length_of(const Eigen::Vector3d& v, const Eigen::Matrix3d& c) {
  const Eigen::Vector3d u = v.norm() > 0 ? v.normalized().eval() : Eigen::Vector3d::UnitX().eval();
  return {v.norm(), std::sqrt(std::max(0.0, u.dot(c * u)))};
}

// What is hardly known, the distance from the camera mostly, is left out.
std::string displaced(const Eigen::Vector3d& v, const Eigen::Matrix3d& c) {
  constexpr double kUnknown_mm = 2.0;
  const SymmetricEigen axes = symmetric_eigen(c);
  const Eigen::Vector3d least_known = axes.vectors.col(2);
  const bool is_across = std::sqrt(axes.values[2]) > kUnknown_mm;
  Eigen::Vector3d known = v;
  if (is_across) known -= v.dot(least_known) * least_known;
  const auto [mm, std_mm] = length_of(known, c);
  return fmt::format("by {:.2f} ± {:.2f} mm{} (x {:+.2f}, y {:+.2f}, z {:+.2f})", mm,
                     std::max(0.01, std_mm), is_across ? " across the line of sight" : "",
                     known.x(), known.y(), known.z());
}

std::string turned(const Eigen::Vector3d& v, const Eigen::Matrix3d& c) {
  const auto [rad, std_rad] = length_of(v, c);
  constexpr double kOutlineDegree = 180 / std::numbers::pi;
  return fmt::format("by {:.2f} ± {:.2f} deg", kOutlineDegree * rad,
                     std::max(0.01, kOutlineDegree * std_rad));
}

std::string text_of(const OutlineExplanation& e, const std::vector<std::string>& names,
                    const std::vector<OutlineShot>& shots) {
  const auto at = [&](Eigen::Index first) { return e.value.segment<3>(first).eval(); };
  const auto c = [&](Eigen::Index first) { return e.covariance.block<3, 3>(first, first).eval(); };
  switch (e.cause) {
    case OutlineCause::kNone:
      return "the outline agrees with pose and mesh";
    case OutlineCause::kMeshDisplaced:
      return fmt::format("mesh of {} displaced: the object is offset from it {}", names[e.which],
                         displaced(at(0), c(0)));
    case OutlineCause::kMeshTurned:
      return fmt::format("mesh of {} turned: the object is turned relative to it {}",
                         names[e.which], turned(at(0), c(0)));
    case OutlineCause::kMeshScale:
      return fmt::format("mesh of {} scaled: the object is {:.2f} ± {:.2f} % {} than its mesh",
                         names[e.which], 100 * std::abs(std::expm1(e.value[0])),
                         100 * std::max(1e-4, std::sqrt(e.covariance(0, 0))),
                         e.value[0] > 0 ? "larger" : "smaller");
    case OutlineCause::kMeshMisplaced:
      return fmt::format(
          "mesh of {} displaced and turned: the object is offset from it {} and turned {}",
          names[e.which], displaced(at(0), c(0)), turned(at(3), c(3)));
    case OutlineCause::kCamera:
      return fmt::format("camera moved since its pose was taken: turned {} and moved {}",
                         turned(at(0), c(0)), displaced(at(3), c(3)));
    case OutlineCause::kShotMoved:
      return fmt::format(
          "object or camera moved in {}: its outline is {:.1f} px {} and {:.1f} px {} of that of "
          "the other shots",
          shots[e.which].file, std::abs(e.value[0]), e.value[0] < 0.0 ? "left" : "right",
          std::abs(e.value[1]), e.value[1] < 0.0 ? "above" : "below");
  }
  throw std::logic_error("text_of: no such cause");
}

class Causes {
 public:
  Causes(const OutlineModel& model, const OutlineOptions& options,
         const std::vector<std::string>& names, const std::vector<OutlineShot>& shots)
      : model_(model), names_(names), shots_(shots) {
    for (const OutlineShot& shot : shots) {
      if (!shot.look.offsets.empty()) bodies_.insert(static_cast<std::size_t>(shot.body_idx));
    }
    known_ = Eigen::VectorXd::Zero(model.columns());
    for (const std::size_t b : bodies_) {
      known_.segment<3>(model.place(b)).setConstant(options.place_std_mm);
      known_.segment<3>(model.turn(b)).setConstant(options.turn_std_rad);
      known_[model.scale(b)] = options.scale_relative_std;
      known_[model.growth(b)] = std::hypot(kGrowth * model.cell_px(), options.growth_std_px);
      known_.segment(model.harmonics(b), OutlineModel::kHarmonics)
          .setConstant(kShotShift * model.cell_px());
    }
    for (std::size_t s = 0; s < shots.size(); ++s) {
      known_.segment<2>(model.shift(s)).setConstant(kShotShift * model.cell_px());
    }
  }

  const Eigen::VectorXd& known() const { return known_; }

  OutlineExplanation none() const { return explanation(OutlineCause::kNone, 0, 0, 0, 0.0, 0); }

  std::vector<OutlineExplanation> all() const {
    std::vector<OutlineExplanation> out;
    for (const std::size_t b : bodies_) {
      out.push_back(
          explanation(OutlineCause::kMeshDisplaced, b, model_.place(b), 3, kFreePlace_mm, 0));
      out.push_back(explanation(OutlineCause::kMeshTurned, b, model_.turn(b), 3, kFreeTurn_rad, 0));
      out.push_back(explanation(OutlineCause::kMeshScale, b, model_.scale(b), 1, kFreeScale, 0));
      out.push_back(explanation(OutlineCause::kMeshMisplaced, b, model_.place(b), 6, kFreePlace_mm,
                                kFreeTurn_rad));
    }
    if (bodies_.size() > 1) {
      out.push_back(explanation(OutlineCause::kCamera, 0, 0, 6, kFreeTurn_rad, kFreePlace_mm));
    }
    if (shots_.size() > 1) {
      for (std::size_t s = 0; s < shots_.size(); ++s) {
        if (shots_[s].look.offsets.empty()) continue;
        out.push_back(
            explanation(OutlineCause::kShotMoved, s, model_.shift(s), 2, kFreeShift_px, 0));
      }
    }
    return out;
  }

 private:
  // The last three of six parameters have the standard deviation `rest`.
  OutlineExplanation explanation(OutlineCause cause, std::size_t which, Eigen::Index first, int n,
                                 double free, double rest) const {
    Eigen::VectorXd std = known_;
    std.segment(first, n).setConstant(free);
    if (n == 6) std.segment(first + 3, 3).setConstant(rest);
    const OutlineModel::Fit f = model_.fit(std, cause != OutlineCause::kCamera);
    OutlineExplanation e;
    e.cause = cause;
    e.which = which;
    e.parameters = n;
    e.chi2 = f.chi2;
    e.value = f.value.segment(first, n);
    e.covariance = f.covariance.block(first, first, n, n);
    e.text = text_of(e, names_, shots_);
    return e;
  }

  const OutlineModel& model_;
  const std::vector<std::string>& names_;
  const std::vector<OutlineShot>& shots_;
  std::set<std::size_t> bodies_;
  Eigen::VectorXd known_;
};

// From the fit of the rig as it is: places and turns of a body about its centre are shifts of the
// pose.
PoseShift shift_of(const OutlineModel& model, const OutlineModel::Fit& fit, const Rigid3d& pose,
                   std::size_t body, const Eigen::Vector3d& center_mm) {
  PoseShift place;
  place << fit.value.segment<3>(model.place(body)), fit.value.segment<3>(model.turn(body));
  return fit.value.head<kOutlinePose>() + pose_shift_by_place(pose, center_mm) * place;
}

}  // namespace

bool may_be_misplaced(const OutlineDiagnosis& diagnosis, std::size_t body) {
  constexpr double kChance = 0.02;
  const std::vector<OutlineExplanation>& all = diagnosis.explanations;
  return std::any_of(all.begin(), all.end(), [&](const OutlineExplanation& e) {
    const bool of_place = e.cause == OutlineCause::kMeshDisplaced ||
                          e.cause == OutlineCause::kMeshTurned ||
                          e.cause == OutlineCause::kMeshMisplaced;
    return of_place && e.which == body &&
           chi_square_tail(std::max(0.0, all.front().chi2 - e.chi2), e.parameters) < kChance;
  });
}

OutlineDiagnosis explain_outlines(const std::vector<OutlineShot>& shots,
                                  const CameraIntrinsics& intrinsics, const PoseResult& pose,
                                  const std::vector<std::string>& names,
                                  const std::vector<Eigen::Vector3d>& centers_mm,
                                  const OutlineOptions& options) {
  const OutlineModel model(shots, intrinsics, pose, centers_mm);
  const Causes causes(model, options, names, shots);
  OutlineDiagnosis out;
  const OutlineExplanation none = causes.none();
  std::vector<OutlineExplanation> others = causes.all();
  const double per_parameter = std::log(std::max(2.0, model.independent_points()));
  const auto score = [&](const OutlineExplanation& e) {
    const bool rare = e.cause != OutlineCause::kMeshDisplaced && e.cause != OutlineCause::kCamera;
    return e.chi2 + e.parameters * per_parameter + (rare ? kRare : 0.0);
  };
  std::sort(others.begin(), others.end(),
            [&](const auto& a, const auto& b) { return score(a) < score(b); });
  for (const OutlineExplanation& e : others) {
    out.agrees = out.agrees &&
                 chi_square_tail(std::max(0.0, none.chi2 - e.chi2), e.parameters) >= kOutlineDoubt;
    out.likely += score(e) <= score(others.front()) + kOutlineCloseScore ? 1 : 0;
  }
  out.explanations = {none};
  out.explanations.insert(out.explanations.end(), others.begin(), others.end());
  for (std::size_t s = 0; s < shots.size(); ++s) {
    const auto points = static_cast<double>(shots[s].look.points);
    out.fitting_share.push_back(points > 0 ? static_cast<double>(model.kept(s)) / points : 0.0);
  }
  // One shift of all shots, with pose and place exact.
  Eigen::VectorXd errors = causes.known();
  errors.head<kOutlinePose>().setZero();
  for (std::size_t b = 0; b < centers_mm.size(); ++b) {
    errors.segment<3>(model.place(b)).setZero();
    errors.segment<3>(model.turn(b)).setZero();
  }
  const OutlineModel::Fit exact = model.fit(errors, false);
  const OutlineModel::Fit known = model.fit(causes.known(), true);
  for (std::size_t b = 0; b < centers_mm.size(); ++b) {
    out.growth_px.push_back(known.value[model.growth(b)]);
  }
  double n = 0;
  for (std::size_t s = 0; s < shots.size(); ++s) {
    Eigen::VectorXd one = errors;
    one.segment<2>(model.shift(s)).setConstant(kFreeShift_px);
    const Eigen::Vector2d of_shot = model.fit(one, false).value.segment<2>(model.shift(s));
    out.shift_px += of_shot;
    n += 1.0;
  }
  out.shift_px /= std::max(1.0, n);
  out.shift_std_px = kShotShift * model.cell_px() / std::sqrt(std::max(1.0, n));
  if (out.agrees && chi_square_tail(std::max(0.0, exact.chi2 - known.chi2), 6) < kOutlineDoubt) {
    for (std::size_t b = 0; b < centers_mm.size(); ++b) {
      out.shifts.push_back(shift_of(model, known, pose.camera_from_world, b, centers_mm[b]));
    }
  }
  return out;
}

}  // namespace scattermeter::calib
