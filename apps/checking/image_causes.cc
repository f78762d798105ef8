#include "apps/checking/image_causes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <Eigen/Core>
#include <fmt/core.h>

#include "core/base/dense_solve.h"

namespace scattermeter::apps {
namespace {

// Prior deviations of what is free: nuisances by this factor, LEDs in mm.
constexpr double kFreed = 100.0;
constexpr double kFreePlace_mm = 50.0;
constexpr double kLeastPlace_mm = 0.1;

struct Candidate {
  ImageCause cause;
  std::function<bool(const std::string&)> frees;  // by the column's name
};

// The columns of all causes and of what is free or has a prior anyway.
class CauseColumns {
 public:
  CauseColumns(const Scene& rig, const std::vector<const SceneShot*>& shots,
               const DenseSystem& system, const LinearModel& model)
      : system_(system), model_(model) {
    for (Eigen::Index i = 0; i < model.jacobian.cols(); ++i) {
      add("", model.jacobian.col(i), 0.0, 0.0);
    }
    if (model.scale_relative_std > 0.0) {
      const bool free = !std::isfinite(model.scale_relative_std);
      add("", model.predicted, free ? 0.0 : model.scale_relative_std, 0.0);
    }
    for (std::size_t i = 0; i < system.nuisances.size(); ++i) {
      const Nuisance& n = system.nuisances[i];
      double std = n.std;
      double freed = kFreed * n.std;
      for (const SceneLight& light : rig.lights) {
        if (light.led() == nullptr || !n.name.starts_with(light.name + ".position")) continue;
        std = std::max(kLeastPlace_mm, light.led()->position_std_mm);
        freed = kFreePlace_mm;
      }
      if (!std::isfinite(std)) std = 0.0;
      add(n.name.empty() ? n.group : n.name + "|" + n.group,
          system.nuisance_columns.col(static_cast<Eigen::Index>(i)), std, freed);
    }
    Eigen::Index first = 0;
    for (std::size_t s = 0; s < shots.size(); ++s) {
      const Eigen::Index count = system.shot_rows[s];
      Eigen::VectorXd own = Eigen::VectorXd::Zero(system.l.size());
      own.segment(first, count) = model.predicted.segment(first, count);
      add("power of " + shots[s]->file, own, -1.0, kWidest);
      own.setZero();
      own.segment(first, count).setConstant(system.l.segment(first, count).mean());
      add("even light", own, -1.0, kWidest);
      first += count;
    }
    for (const SceneLight& light : rig.lights) add_power_of(light.name, shots);
    accumulate();
  }

  const std::vector<std::string>& names() const { return names_; }

  // Sum of squares with the columns that `frees` names free.
  double chi2(const std::function<bool(const std::string&)>& frees) const {
    std::vector<Eigen::Index> used;
    std::vector<double> std;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const bool freed = frees && frees(names_[i]);
      if (std_[i] < 0.0 && !freed) continue;
      used.push_back(static_cast<Eigen::Index>(i));
      std.push_back(freed ? freed_[i] : std_[i]);
    }
    Eigen::MatrixXd normal = normal_(used, used);
    for (std::size_t i = 0; i < used.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (std[i] > 0.0) normal(at, at) += 1.0 / (std[i] * std[i]);
    }
    const Eigen::VectorXd unit = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = unit.asDiagonal() * normal * unit.asDiagonal();
    const Eigen::VectorXd right = gradient_(used);
    const Eigen::VectorXd x =
        unit.cwiseProduct(SymmetricSolver(scaled).solve(unit.cwiseProduct(right)));
    return std::max(0.0, squares_ - right.dot(x));
  }

 private:
  // std: of the prior; 0: free, < 0: absent unless freed.
  void add(const std::string& name, const Eigen::VectorXd& column, double std, double freed) {
    names_.push_back(name);
    columns_.push_back(column);
    std_.push_back(std);
    freed_.push_back(freed);
  }
  void add_power_of(const std::string& light, const std::vector<const SceneShot*>& shots) {
    Eigen::VectorXd own = Eigen::VectorXd::Zero(system_.l.size());
    Eigen::Index first = 0;
    std::size_t lit = 0;
    for (std::size_t s = 0; s < shots.size(); ++s) {
      const Eigen::Index count = system_.shot_rows[s];
      if (shots[s]->lights == std::vector<std::string>{light}) {
        own.segment(first, count) = model_.predicted.segment(first, count);
        ++lit;
      }
      first += count;
    }
    // One shot has its own power; all of them have the scale.
    if (lit > 1 && lit < shots.size()) add("power of " + light, own, -1.0, kWidest);
  }
  void accumulate() {
    Eigen::MatrixXd a(system_.l.size(), static_cast<Eigen::Index>(columns_.size()));
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      a.col(static_cast<Eigen::Index>(i)) = columns_[i].cwiseQuotient(system_.std_l);
    }
    const Eigen::VectorXd rest = (system_.l - model_.predicted).cwiseQuotient(system_.std_l);
    normal_ = a.transpose() * a;
    gradient_ = a.transpose() * rest;
    squares_ = rest.squaredNorm();
  }

  const DenseSystem& system_;
  const LinearModel& model_;
  std::vector<std::string> names_;
  std::vector<Eigen::VectorXd> columns_;
  std::vector<double> std_, freed_;
  // Of the rows, weighted by their deviations.
  Eigen::MatrixXd normal_;
  Eigen::VectorXd gradient_;
  double squares_ = 0;
};

std::vector<Candidate> candidates(const Scene& rig, const CauseColumns& columns) {
  std::vector<Candidate> out;
  const auto add = [&](const std::string& text, const std::string& advice,
                       std::function<bool(const std::string&)> frees) {
    Candidate c;
    c.cause.text = text;
    c.cause.advice = advice;
    c.cause.parameters =
        static_cast<int>(std::count_if(columns.names().begin(), columns.names().end(), frees));
    c.frees = std::move(frees);
    if (c.cause.parameters > 0) out.push_back(std::move(c));
  };
  for (const SceneLight& light : rig.lights) {
    const std::string prefix = light.name + ".position";
    add(light.name + " displaced", "measure its position_mm again (calibrate led)",
        [prefix](const std::string& n) { return n.starts_with(prefix); });
    const std::string power = "power of " + light.name;
    add("power of " + light.name + " off",
        "measure its intensity_W_per_sr again, or let it warm up",
        [power](const std::string& n) { return n == power; });
  }
  for (const SceneShot& shot : rig.shots) {
    const std::string power = "power of " + shot.file;
    add("light of " + shot.file + " off",
        "check aperture, exposure and LED current of this shot, and whether it is the right file",
        [power](const std::string& n) { return n == power; });
  }
  add("light from elsewhere",
      "switch off every other lamp, close the blinds, or list a light of type ambient",
      [](const std::string& n) { return n == "even light"; });
  add("camera knocked or object displaced", "take the pose points again, and look at the outlines",
      [](const std::string& n) { return n.ends_with("|pose") || n == "pose"; });
  add("eta off", "state the refractive index of the material (objects.eta)",
      [](const std::string& n) { return n.ends_with("|eta") || n == "eta"; });
  return out;
}

}  // namespace

std::vector<ImageCause> image_causes(const Scene& rig, const std::vector<const SceneShot*>& shots,
                                     const DenseSystem& system, const LinearModel& model) {
  const CauseColumns columns(rig, shots, system, model);
  const double nothing = columns.chi2({});
  const auto rows = static_cast<double>(system.l.size());
  std::vector<ImageCause> out;
  double least = nothing;
  for (const Candidate& c : candidates(rig, columns)) {
    ImageCause& cause = out.emplace_back(c.cause);
    cause.chi2_drop = nothing - columns.chi2(c.frees);
    least = std::min(least, nothing - cause.chi2_drop);
  }
  const double unit = std::max(1.0, least / std::max(1.0, rows));
  for (ImageCause& cause : out) {
    cause.share = std::clamp(cause.chi2_drop / std::max(1.0, nothing - rows), 0.0, 1.0);
    cause.chi2_drop /= unit;
  }
  const auto score = [&](const ImageCause& c) {
    return c.chi2_drop - c.parameters * std::log(std::max(2.0, rows));
  };
  std::sort(out.begin(), out.end(),
            [&](const auto& a, const auto& b) { return score(a) > score(b); });
  return out;
}

}  // namespace scattermeter::apps
