// Any bytes as a mesh: read, or refused by InputError.
#include <cstddef>
#include <cstdint>
#include <string>

#include "capture/files/obj_reader.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.obj");
  const auto read = [](const std::string& path) {
    return scattermeter::capture::read_obj(path, 100'000);
  };
  scattermeter::read_or_refuse(read, file.with(data, size));
  return 0;
}
