// Any bytes as a light probe (Radiance or OpenEXR): read, or refused by InputError.
#include <cstddef>
#include <cstdint>
#include <string>

#include "capture/files/probe_reader.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.hdr");
  const auto read = [](const std::string& path) {
    return scattermeter::capture::read_probe(path, {1 << 20});
  };
  scattermeter::read_or_refuse(read, file.with(data, size));
  return 0;
}
