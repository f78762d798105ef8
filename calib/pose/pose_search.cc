#include "calib/pose/pose_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

namespace scattermeter::calib {
namespace {

// Up to this number of triples (n <= 13) all are tried.
constexpr size_t kAllTriples = 300;
// Three points of a small object determine a poor pose under a long lens even if all are inliers:
// triples that span it well must be drawn, too, whatever the share of inliers.
constexpr size_t kLeastTrials = 150;
constexpr size_t kMostTrials = 1500;

struct Scored {
  double cost = std::numeric_limits<double>::infinity();
  std::vector<bool> inlier;
  int inliers = 0;
};

Scored score(const PoseScene& scene, const ScenePose& pose, double inlier_px) {
  Scored out;
  const double limit = inlier_px * inlier_px;
  out.cost = 0;
  out.inlier.resize(scene.points.size());
  for (size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3d x = pose.rotation * scene.points[i] + pose.center;
    const double square = (scene.lens.project(x) - scene.image_px[i]).squaredNorm();
    out.inlier[i] = square <= limit;  // false for NaN
    out.inliers += out.inlier[i] ? 1 : 0;
    out.cost += out.inlier[i] ? square : limit;
  }
  return out;
}

std::vector<std::vector<size_t>> all_triples(const std::vector<size_t>& usable) {
  std::vector<std::vector<size_t>> triples;
  for (size_t i = 0; i < usable.size(); ++i) {
    for (size_t j = i + 1; j < usable.size(); ++j) {
      for (size_t k = j + 1; k < usable.size(); ++k) {
        triples.push_back({usable[i], usable[j], usable[k]});
      }
    }
  }
  return triples;
}

std::vector<size_t> random_triple(const std::vector<size_t>& usable, std::mt19937_64* random) {
  // std::uniform_int_distribution is not used: its algorithm depends on the standard library, and
  // the digits of a result should not. The bias of the remainder is 1e-16 here.
  std::array<size_t, 3> picked{};
  const auto draw = [&] { return static_cast<size_t>((*random)() % usable.size()); };
  picked[0] = draw();
  do picked[1] = draw();
  while (picked[1] == picked[0]);
  do picked[2] = draw();
  while (picked[2] == picked[0] || picked[2] == picked[1]);
  return {usable[picked[0]], usable[picked[1]], usable[picked[2]]};
}

// The number of trials after which a triple of inliers has been drawn with the given confidence.
size_t trials_needed(int inliers, size_t pairs, double confidence) {
  const double share = static_cast<double>(inliers) / static_cast<double>(pairs);
  const double miss = 1 - share * share * share;
  if (miss <= 0) return kLeastTrials;
  const double trials = std::log(1 - confidence) / std::log(miss);
  return std::max(kLeastTrials,
                  trials < kMostTrials ? static_cast<size_t>(trials) + 1 : kMostTrials);
}

}  // namespace

std::vector<ScenePose> poses_from_three(const PoseScene& scene, const std::vector<size_t>& triple) {
  const Eigen::Vector3d& a = scene.points[triple[0]];
  const Eigen::Vector3d ab = scene.points[triple[1]] - a;
  const Eigen::Vector3d ac = scene.points[triple[2]] - a;
  // Twice the area over the product of two sides: the sine of an angle of the triangle.
  if (!(ab.cross(ac).norm() > 1e-3 * ab.norm() * ac.norm())) return {};

  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  for (const size_t i : triple) {
    object.emplace_back(scene.points[i].x(), scene.points[i].y(), scene.points[i].z());
    image.emplace_back(scene.rays[i].x(), scene.rays[i].y());
  }
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  try {
    // AP3P, not SOLVEPNP_P3P: of 3000 noise-free triples OpenCV 4.6 solves 3000 to 1e-5 with the
    // former and 947 with the latter, in 10 us each with either.
    cv::solveP3P(object, image, cv::Matx33d::eye(), cv::noArray(), rotations, translations,
                 cv::SOLVEPNP_AP3P);
  } catch (const cv::Exception&) {
    return {};
  }
  std::vector<ScenePose> poses;
  for (size_t k = 0; k < rotations.size(); ++k) {
    const auto* w = rotations[k].ptr<double>();
    const auto* t = translations[k].ptr<double>();
    const Eigen::Vector3d turn(w[0], w[1], w[2]);
    ScenePose pose;
    pose.rotation = turn.norm() > 0
                        ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()
                        : Eigen::Matrix3d::Identity();
    pose.center = Eigen::Vector3d(t[0], t[1], t[2]);
    if (pose.rotation.allFinite() && pose.center.allFinite()) poses.push_back(pose);
  }
  return poses;
}

PoseConsensus find_consensus(const PoseScene& scene, double inlier_px, double confidence) {
  const size_t n = scene.points.size();
  PoseConsensus best;
  best.inlier.assign(n, false);
  double best_cost = std::numeric_limits<double>::infinity();
  double best_raw_cost = std::numeric_limits<double>::infinity();

  std::vector<size_t> usable;  // an image point beyond the distortion's range gives no hypothesis
  for (size_t i = 0; i < n; ++i) {
    if (scene.rays[i].allFinite()) usable.push_back(i);
  }
  if (usable.size() < 3) return best;
  std::vector<std::vector<size_t>> list;
  const size_t u = usable.size();
  if (u * (u - 1) * (u - 2) / 6 <= kAllTriples) list = all_triples(usable);
  std::mt19937_64 random(20180417);

  size_t trials = list.empty() ? kMostTrials : list.size();
  for (size_t trial = 0; trial < trials; ++trial) {
    const std::vector<size_t> triple = list.empty() ? random_triple(usable, &random) : list[trial];
    for (const ScenePose& hypothesis : poses_from_three(scene, triple)) {
      // A wide initial threshold: a pose from three noisy points under a long lens misses the
      // others by more than the final threshold, by which each refined pose is then judged.
      Scored raw = score(scene, hypothesis, 3 * inlier_px);
      if (raw.inliers < 4 || raw.cost >= best_raw_cost) continue;
      best_raw_cost = raw.cost;
      PoseFit fit;
      fit.pose = hypothesis;
      std::vector<bool> inlier = raw.inlier;
      for (int round = 0; round < 3; ++round) {
        fit = refine_pose(scene, inlier, fit.pose, 10);
        const Scored refined = score(scene, fit.pose, inlier_px);
        if (refined.cost < best_cost) {
          best_cost = refined.cost;
          best = {fit, refined.inlier, refined.inliers};
        }
        if (refined.inliers < 4 || refined.inlier == inlier) break;
        inlier = refined.inlier;
      }
      if (list.empty()) trials = std::min(trials, trials_needed(best.inliers, n, confidence));
    }
  }
  return best;
}

}  // namespace scattermeter::calib
