// Any bytes as the file of a calibration of camera, radiance or LED: read, or refused by
// InputError.
#include <cstddef>
#include <cstdint>

#include "apps/rig/led_calibration_file.h"
#include "apps/rig/radiance_file.h"
#include "calib/lens/camera_calibration_file.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.yaml");
  const std::string& path = file.with(data, size);
  scattermeter::read_or_refuse(scattermeter::calib::read_camera_calibration_file, path);
  scattermeter::read_or_refuse(scattermeter::apps::read_radiance_file, path);
  scattermeter::read_or_refuse(scattermeter::apps::read_led_calibration_file, path);
  return 0;
}
