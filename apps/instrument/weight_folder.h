// Weights W in a folder.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "apps/instrument/kept_folder.h"
#include "core/diffusion/weight_store.h"

namespace scattermeter::apps {

class WeightFolder : public FolderStore<WeightMatrix> {
 public:
  explicit WeightFolder(std::string folder) : FolderStore(std::move(folder), ".weights") {}

 private:
  std::string bytes_of(const WeightMatrix& weights) const override;
  std::optional<WeightMatrix> kept_in(std::string_view bytes) const override;
};

}  // namespace scattermeter::apps
