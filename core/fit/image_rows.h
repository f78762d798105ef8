// The used rows of an image, one shot at a time: no more than one shot's need be in memory.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/fit/linear_shot.h"

namespace scattermeter {

// The rows of one shot with the nuisances that touch them; system->nuisances[k] is number
// nuisances[k] of the image's, ascending.
struct ShotSystem {
  std::shared_ptr<const DenseSystem> system;
  std::vector<Eigen::Index> nuisances;
};

class ImageRows {
 public:
  virtual ~ImageRows() = default;
  virtual std::size_t shots() const = 0;
  // Of all shots; those that are fitted come first.
  virtual const std::vector<Nuisance>& nuisances() const = 0;
  // May be called by several threads at once, and as often as wanted: the same digits each time.
  virtual ShotSystem shot(std::size_t shot) const = 0;
};

// Those of a system that is there as a whole and outlives this. Without shot_rows it is one shot.
class SystemRows final : public ImageRows {
 public:
  explicit SystemRows(const DenseSystem& system) : system_(system) {}
  std::size_t shots() const override;
  const std::vector<Nuisance>& nuisances() const override { return system_.nuisances; }
  ShotSystem shot(std::size_t shot) const override;

 private:
  const DenseSystem& system_;
};

// visit(s, rows of shot s), several at once; a thread that waits begins no work of others
// meanwhile.
void for_each_shot(const ImageRows& image,
                   const std::function<void(std::size_t, const ShotSystem&)>& visit);

// Every step-th row of the image, from the first on, with all nuisances.
DenseSystem stacked(const ImageRows& image, Eigen::Index step = 1);

}  // namespace scattermeter
