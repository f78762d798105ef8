#include "core/fit/image_rows.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace scattermeter {

std::size_t SystemRows::shots() const { return std::max<std::size_t>(1, system_.shot_rows.size()); }

ShotSystem SystemRows::shot(std::size_t shot) const {
  if (system_.shot_rows.size() < 2) {
    std::vector<Eigen::Index> all(system_.nuisances.size());
    std::iota(all.begin(), all.end(), Eigen::Index{0});
    // The system itself, which is not this one's to delete.
    return {std::shared_ptr<const DenseSystem>(std::shared_ptr<const DenseSystem>(), &system_),
            std::move(all)};
  }
  return {std::make_shared<const DenseSystem>(shot_of(system_, shot)),
          nuisances_of_shot(system_, shot)};
}

ShotSystem KeptRows::shot(std::size_t shot) const {
  {
    const std::lock_guard lock(mutex_);
    if (kept_[shot]) return *kept_[shot];
  }
  ShotSystem out = image_.shot(shot);
  const DenseSystem& system = *out.system;
  const auto numbers = system.weights.size() + system.nuisance_columns.size() + 2 * system.l.size();
  const std::size_t bytes = static_cast<std::size_t>(numbers) * sizeof(double);
  const std::lock_guard lock(mutex_);
  if (!kept_[shot] && bytes_ + bytes <= most_bytes_) {
    bytes_ += bytes;
    kept_[shot] = out;
  }
  return out;
}

void for_each_shot(const ImageRows& image,
                   const std::function<void(std::size_t, const ShotSystem&)>& visit) {
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, image.shots(),
                      [&](std::size_t s) { visit(s, image.shot(s)); });
  });
}

DenseSystem stacked(const ImageRows& image, Eigen::Index step) {
  if (step < 1) throw std::invalid_argument("stacked: step");
  std::vector<std::pair<DenseSystem, std::vector<Eigen::Index>>> parts;
  Eigen::Index seen = 0;
  Eigen::Index rows = 0;
  for (std::size_t s = 0; s < image.shots(); ++s) {
    const ShotSystem shot = image.shot(s);
    const Eigen::Index of_shot = shot.system->l.size();
    std::vector<Eigen::Index> kept;
    for (Eigen::Index j = (step - seen % step) % step; j < of_shot; j += step) kept.push_back(j);
    seen += of_shot;
    rows += static_cast<Eigen::Index>(kept.size());
    parts.emplace_back(selected(*shot.system, kept), shot.nuisances);
  }
  DenseSystem out;
  out.weights.resize(rows, parts.empty() ? 0 : parts.front().first.weights.cols());
  out.l.resize(rows);
  out.std_l.resize(rows);
  out.nuisances = image.nuisances();
  if (!out.nuisances.empty()) {
    out.nuisance_columns =
        Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(out.nuisances.size()));
  }
  Eigen::Index at = 0;
  for (auto& [part, nuisances] : parts) {
    const Eigen::Index n = part.l.size();
    out.weights.middleRows(at, n) = part.weights;
    out.l.segment(at, n) = part.l;
    out.std_l.segment(at, n) = part.std_l;
    for (std::size_t k = 0; k < nuisances.size(); ++k) {
      out.nuisance_columns.col(nuisances[k]).segment(at, n) =
          part.nuisance_columns.col(static_cast<Eigen::Index>(k));
    }
    out.shot_rows.push_back(n);
    at += n;
    part = {};
  }
  return out;
}

}  // namespace scattermeter
