#include "tests/fuzz/fuzz_file.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

// Short traces of allocations and a short quarantine: a quarter of the memory, up to 1.3 times as
// many runs in a second. A finding is shown in full by that one input and ASAN_OPTIONS, which come
// after these.
extern "C" const char* __asan_default_options();  // NOLINT: the sanitizer's name
extern "C" const char* __asan_default_options() {
  return "malloc_context_size=4:quarantine_size_mb=8";
}

namespace scattermeter {

FuzzFile::FuzzFile(const std::string& name) {
  const std::filesystem::path memory = "/dev/shm";
  const auto root =
      access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
  folder_ = root / ("scattermeter_fuzz_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder_);
  path_ = folder_ / name;
}

FuzzFile::~FuzzFile() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void FuzzFile::put_beside(const std::string& path) const {
  std::filesystem::copy_file(path, folder_ / std::filesystem::path(path).filename());
}

const std::string& FuzzFile::with(const std::uint8_t* data, std::size_t size) const {
  std::ofstream out(path_, std::ios::binary | std::ios::trunc);
  const std::string bytes(data, data + size);
  out.write(bytes.data(), static_cast<std::streamsize>(size));
  out.close();
  if (!out) std::abort();
  return path_;
}

}  // namespace scattermeter
