// Weights W in a folder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/instrument/content_name.h"
#include "apps/instrument/kept_folder.h"
#include "core/diffusion/weight_store.h"

namespace scattermeter::apps {

class WeightFolder : public WeightStore {
 public:
  explicit WeightFolder(std::string folder, std::uintmax_t most_bytes = KeptFolder::kMostBytes)
      : files_(std::move(folder), ".weights", most_bytes) {}

  std::string name(const std::vector<double>& numbers) const override {
    return content_name(numbers);
  }
  std::optional<WeightMatrix> find(const std::string& name) override;
  void keep(const std::string& name, const WeightMatrix& weights) override;
  std::string write() { return files_.write(); }  // KeptFolder::write()

 private:
  KeptFolder files_;
};

}  // namespace scattermeter::apps
