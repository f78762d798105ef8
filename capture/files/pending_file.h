// Files that appear complete or not at all.
#pragma once

#include <string>
#include <string_view>

namespace scattermeter::capture {

// A temporary file in the folder of `path` that commit() renames to `path` in one step, so that no
// reader ever sees half a file. Destroyed without commit(), it removes the temporary file and
// leaves any existing file at `path` untouched.
class PendingFile {
 public:
  // Creates the temporary file. Throws InputError naming `path` when that fails.
  explicit PendingFile(std::string path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  // Open for reading and writing, positioned at the start. Owned by this object.
  int descriptor() const { return descriptor_; }
  const std::string& temporary_path() const { return temporary_path_; }

  // Closes the temporary file and renames it. Throws InputError naming `path` when either fails.
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;
  int descriptor_ = -1;
};

// Creates the folder that `path` lies in, with its parents. Throws InputError naming the folder.
void make_folder_of(const std::string& path);

// Writes all of `bytes` to an open file, continuing after signals and partial writes. Throws
// InputError naming `path`, the file that the descriptor belongs to.
void write_all(int descriptor, std::string_view bytes, const std::string& path);

// Writes a whole file through a PendingFile; missing folders are created. Throws InputError naming
// the file or folder.
void write_text_file(const std::string& path, std::string_view bytes);

}  // namespace scattermeter::capture
