// The used rows of an image, one shot at a time, so that the whole system need not be in memory.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/fit/linear_shot.h"

namespace scattermeter {

// The rows of one shot with the nuisances that affect them; system->nuisances[k] is the image's
// nuisance number nuisances[k], ascending.
struct ShotSystem {
  std::shared_ptr<const DenseSystem> system;
  std::vector<Eigen::Index> nuisances;
  // The part of the shot in which each row lies, from 0 without gaps; empty: not divided.
  std::vector<int> part_of_row = {};
  // The same with parts of a few neighbours each.
  std::vector<int> cell_of_row = {};
};

class ImageRows {
 public:
  virtual ~ImageRows() = default;
  virtual std::size_t shots() const = 0;
  // Of all shots; the fitted ones come first.
  virtual const std::vector<Nuisance>& nuisances() const = 0;
  // Thread-safe and repeatable: the same digits each time.
  virtual ShotSystem shot(std::size_t shot) const = 0;
};

// The rows of a system that is in memory as a whole and outlives this. Without shot_rows it is one
// shot.
class SystemRows final : public ImageRows {
 public:
  explicit SystemRows(const DenseSystem& system) : system_(system) {}
  std::size_t shots() const override;
  const std::vector<Nuisance>& nuisances() const override { return system_.nuisances; }
  ShotSystem shot(std::size_t shot) const override;

 private:
  const DenseSystem& system_;
};

// Those of another image, which outlives this and does not change, each computed once as long as
// all that are kept take no more than `most_bytes`.
class KeptRows final : public ImageRows {
 public:
  // By default, 150,000 rows with 50 nuisances on 60 knots fit.
  explicit KeptRows(const ImageRows& image, std::size_t most_bytes = std::size_t{1} << 27)
      : image_(image), most_bytes_(most_bytes), kept_(image.shots()) {}
  std::size_t shots() const override { return image_.shots(); }
  const std::vector<Nuisance>& nuisances() const override { return image_.nuisances(); }
  ShotSystem shot(std::size_t shot) const override;

 private:
  const ImageRows& image_;
  std::size_t most_bytes_;
  mutable std::mutex mutex_;
  mutable std::size_t bytes_ = 0;
  mutable std::vector<std::optional<ShotSystem>> kept_;
};

// Calls visit(s, rows of shot s), several in parallel; a waiting thread does not start unrelated
// work.
void for_each_shot(const ImageRows& image,
                   const std::function<void(std::size_t, const ShotSystem&)>& visit);

// Every step-th row of the image, from the first on, with all nuisances.
DenseSystem stacked(const ImageRows& image, Eigen::Index step = 1);

}  // namespace scattermeter
