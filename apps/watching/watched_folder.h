// A folder that a camera's program or a card reader fills, followed by looking at it repeatedly.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scattermeter::apps {

enum class FolderEvent {
  kComplete,  // a new file, or an old one with other contents
  kRenamed,   // the file `other` under another name
  kDoubled,   // the contents of the file `other`, which is still there
  kGone,
};

struct FolderNews {
  FolderEvent event = FolderEvent::kComplete;
  std::string name;   // of the file in the folder
  std::string other;  // of the one before, or of the same contents
};

class WatchedFolder {
 public:
  // Throws InputError unless the folder is there and can be read.
  explicit WatchedFolder(std::string folder);

  const std::string& folder() const { return folder_; }
  std::string path_of(const std::string& name) const;

  // What changed since the last look, in the order of the files' times and then names. A file
  // counts as complete once its size and time are those of the last look, and as gone once two
  // looks have missed it: programs write under a temporary name, or in several steps. Hidden files
  // and empty ones are not there. Throws InputError if the folder can no longer be read.
  std::vector<FolderNews> look();

 private:
  struct File {
    std::uintmax_t size = 0;
    std::filesystem::file_time_type time;
    std::string sha256;  // "": not complete yet
    int looks_missed = 0;
  };
  std::map<std::string, File> present() const;
  FolderNews completed(const std::string& name);
  // Another complete file with these contents; "": none.
  std::string same_contents(const std::string& name) const;

  std::string folder_;
  std::map<std::string, File> files_;
};

}  // namespace scattermeter::apps
