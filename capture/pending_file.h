// A file that appears complete or not at all.
#pragma once

#include <string>

namespace scattermeter::capture {

// Reserves a temporary file in the folder of `path`; commit() renames it to `path` in one step, so
// that a reader never meets half a file. Destroyed without commit(), it removes the temporary and
// leaves whatever stood at `path` as it was.
class PendingFile {
 public:
  // Creates the temporary. Throws InputError naming `path` when the folder takes no new file.
  explicit PendingFile(std::string path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  // Open for writing and reading, at its start. Owned by this object.
  int descriptor() const { return descriptor_; }
  const std::string& temporary_path() const { return temporary_path_; }

  // Closes and renames. Throws InputError naming `path` when either fails.
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;
  int descriptor_ = -1;
};

}  // namespace scattermeter::capture
