#include "tests/fuzz/fuzz_file.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace scattermeter {

FuzzFile::FuzzFile(const std::string& name) {
  const std::filesystem::path memory = "/dev/shm";
  const auto root =
      access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
  folder_ = root / ("scattermeter_fuzz_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder_);
  path_ = folder_ + "/" + name;
}

FuzzFile::~FuzzFile() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

const std::string& FuzzFile::with(const std::uint8_t* data, std::size_t size) const {
  std::ofstream out(path_, std::ios::binary | std::ios::trunc);
  for (std::size_t i = 0; i < size; ++i) out.put(static_cast<char>(data[i]));
  out.close();
  if (!out) std::abort();
  return path_;
}

}  // namespace scattermeter
