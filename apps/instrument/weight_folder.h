// Weights W in a folder.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/diffusion/weight_store.h"

namespace scattermeter::apps {

// FOLDER/NAME.weights, by content_name(). What is to be kept waits for write(), so that a
// measurement that fails leaves nothing behind. A file appears complete or not at all, and one with
// a wrong digest is ignored. Of more than most_bytes, the files that were not used for longest are
// removed.
class WeightFolder : public WeightStore {
 public:
  explicit WeightFolder(std::string folder, std::uintmax_t most_bytes = std::uintmax_t{1} << 30);

  std::string name(const std::vector<double>& numbers) const override;
  std::optional<WeightMatrix> find(const std::string& name) override;
  void keep(const std::string& name, const WeightMatrix& weights) override;

  // Writes all that waits. Returns why the first that failed did; "" if none.
  std::string write();

 private:
  std::string path_of(const std::string& name) const;
  void remove_oldest();

  std::string folder_;
  std::uintmax_t most_bytes_;
  std::mutex mutex_;
  std::vector<std::pair<std::string, std::string>> waiting_;  // paths and contents
};

}  // namespace scattermeter::apps
