// The nodes of a transport atlas in a folder.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/atlas/atlas_store.h"

namespace scattermeter::apps {

// FOLDER/BODY/CENTER/NODE.paths: BODY is the content_name() of the body's numbers, CENTER "x,y,z"
// in mm. A file appears complete or not at all, and one with a wrong digest is ignored; a lock per
// body keeps programs that write at once from replacing many paths by fewer. Of a program that is
// killed, only the node in work is lost.
class AtlasFolder : public AtlasStore {
 public:
  explicit AtlasFolder(std::string folder) : folder_(std::move(folder)) {}

  std::string name(const std::vector<double>& numbers) const override;
  std::vector<Eigen::Vector3d> centers_mm(const std::string& body) override;
  std::optional<WhiteSums> find(const std::string& body, const Eigen::Vector3d& center_mm,
                                int node) override;
  void keep(const std::string& body, const Eigen::Vector3d& center_mm, int node,
            const WhiteSums& sums) override;

  // Why the first node that could not be kept failed; empty if all were kept.
  const std::string& problem() const { return problem_; }

 private:
  std::string folder_of(const std::string& body) const;
  std::string path_of(const std::string& body, const Eigen::Vector3d& center_mm, int node) const;
  std::string folder_;
  std::string problem_;
  // Of files as this object last saw them.
  struct Seen {
    std::filesystem::file_time_type at;
    int levels;
  };
  std::map<std::string, Seen> seen_;
};

}  // namespace scattermeter::apps
