#include "capture/shots/shot_folder.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "core/base/input_error.h"
#include "core/base/nearest_name.h"

namespace scattermeter::capture {

namespace fs = std::filesystem;

std::set<std::string> files_of_shots(const std::string& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) throw MissingFile(folder, "the folder of shots does not exist");
  if (!fs::is_directory(status)) throw InputError(folder, "is a file, not a folder of shots");
  std::set<std::string> present;
  std::string inner;  // a folder in it
  try {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with('.')) continue;
      if (entry.is_directory()) {
        inner = name;
      } else {
        present.insert(name);
      }
    }
  } catch (const fs::filesystem_error& e) {
    throw InputError(folder, "the folder of shots cannot be read: " + e.code().message());
  }
  if (present.empty() && !inner.empty()) {
    throw InputError(folder, "the folder of shots holds no file, but the folder " + inner +
                                 "; name that which holds the shots");
  }
  if (present.empty()) throw InputError(folder, "the folder of shots is empty");
  return present;
}

ShotFolder match_shots(const Scene& scene, const std::set<std::string>& also_listed,
                       const std::string& folder) {
  const std::set<std::string> present = files_of_shots(folder);
  ShotFolder out;
  std::string missing, nearest;
  int first_line = 0;
  for (const SceneShot& shot : scene.shots) {
    std::vector<std::string>& paths = out.paths.emplace_back();
    for (const std::string& file : shot.files()) {
      if (!present.contains(file)) {
        if (first_line == 0) {
          first_line = shot.line;
          nearest = did_you_mean(file, {present.begin(), present.end()});
        }
        missing += (missing.empty() ? "" : ", ") + file;
      }
      paths.push_back((fs::path(folder) / file).string());
    }
  }
  if (!missing.empty()) {
    throw MissingFile(scene.at(first_line) + ": shots.file",
                      "listed, but not in the folder " + folder + ": " + missing +
                          (missing.find(", ") == std::string::npos ? nearest : ""));
  }
  std::set<std::string> listed = also_listed;
  for (const SceneShot& shot : scene.shots) {
    for (const std::string& file : shot.files()) listed.insert(file);
  }
  std::set_difference(present.begin(), present.end(), listed.begin(), listed.end(),
                      std::back_inserter(out.unlisted));
  return out;
}

}  // namespace scattermeter::capture
