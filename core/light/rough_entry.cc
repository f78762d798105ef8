#include "core/light/rough_entry.h"

#include <optional>
#include <utility>

#include "core/material/rough_boundary.h"

namespace scattermeter {
namespace {

class RoughEntry : public EntrySource {
 public:
  RoughEntry(std::unique_ptr<EntrySource> arriving, const RoughBoundary& boundary)
      : arriving_(std::move(arriving)), boundary_(boundary) {}

  std::optional<Entry> sample(double stratum, RandomStream& random) const override {
    std::optional<Entry> entry = arriving_->sample(stratum, random);
    if (!entry) return entry;
    const RoughBoundary::Meeting met = boundary_.meet(entry->direction, entry->normal, random);
    if (!met.passed) return std::nullopt;
    entry->direction = met.direction;
    return entry;
  }

 private:
  std::unique_ptr<EntrySource> arriving_;
  RoughBoundary boundary_;
};

}  // namespace

std::unique_ptr<EntrySource> rough_entry(std::unique_ptr<EntrySource> arriving,
                                         double surface_alpha, double eta_int_over_ext) {
  return std::make_unique<RoughEntry>(std::move(arriving),
                                      RoughBoundary(surface_alpha, eta_int_over_ext));
}

}  // namespace scattermeter
