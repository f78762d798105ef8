// A fuzzer's bytes as a file, for readers that take a path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/input_error.h"

namespace scattermeter {

// The file stands in a folder of this process, in memory where the system has such a place; both
// are gone with the process.
class FuzzFile {
 public:
  explicit FuzzFile(const std::string& name);
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;
  ~FuzzFile();
  // A copy of that file in the same folder, for what a fuzzed file refers to.
  void put_beside(const std::string& path) const;
  // The path, now with these bytes.
  const std::string& with(const std::uint8_t* data, std::size_t size) const;

 private:
  std::filesystem::path folder_;
  std::string path_;
};

// read(path): whatever the file holds, it is read or refused by InputError.
template <typename Read>
void read_or_refuse(const Read& read, const std::string& path) {
  try {
    (void)read(path);
  } catch (const InputError&) {
  }
}

}  // namespace scattermeter
