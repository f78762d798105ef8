// Any bytes as a rig file: read, or refused by InputError.
#include <cstddef>
#include <cstdint>
#include <string>

#include "apps/rig.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.yaml");
  const auto read = [](const std::string& path) { return scattermeter::apps::read_rig(path); };
  scattermeter::read_or_refuse(read, file.with(data, size));
  return 0;
}
