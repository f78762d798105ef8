// The views of a jig in a folder.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/instrument/content_name.h"
#include "apps/instrument/kept_folder.h"
#include "core/view/sample_map_store.h"

namespace scattermeter::apps {

class SampleMapFolder : public SampleMapStore {
 public:
  explicit SampleMapFolder(std::string folder) : files_(std::move(folder), ".map") {}

  std::string name(const std::vector<double>& numbers) const override {
    return content_name(numbers);
  }
  std::optional<SampleMap> find(const std::string& name) override;
  void keep(const std::string& name, const SampleMap& map) override;
  std::string write() { return files_.write(); }  // KeptFolder::write()

 private:
  KeptFolder files_;
};

}  // namespace scattermeter::apps
