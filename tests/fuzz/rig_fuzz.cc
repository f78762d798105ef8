// Any bytes as a rig file, beside calibrations that it may name: read, or refused by InputError.
#include <cstddef>
#include <cstdint>
#include <string>

#include "apps/rig/rig.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

const scattermeter::FuzzFile& file() {
  static const scattermeter::FuzzFile file("a.yaml");
  static const bool beside = [] {
    for (const char* name : {"camera.yaml", "led.yaml", "radiance.yaml"}) {
      file.put_beside(SCATTERMETER_SOURCE_DIR "/tests/fuzz/seeds/" + std::string(name));
    }
    return true;
  }();
  (void)beside;
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto read = [](const std::string& path) { return scattermeter::apps::read_rig(path); };
  scattermeter::read_or_refuse(read, file().with(data, size));
  return 0;
}
