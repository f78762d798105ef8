// The views of a jig in a folder.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "apps/instrument/kept_folder.h"
#include "core/view/sample_map_store.h"

namespace scattermeter::apps {

class SampleMapFolder : public FolderStore<SampleMap> {
 public:
  explicit SampleMapFolder(std::string folder) : FolderStore(std::move(folder), ".map") {}

 private:
  std::string bytes_of(const SampleMap& map) const override;
  std::optional<SampleMap> kept_in(std::string_view bytes) const override;
};

}  // namespace scattermeter::apps
