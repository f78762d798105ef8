// Any bytes as an ordinary picture of a calibration board: read through OpenCV, or refused by
// InputError.
#include <cstddef>
#include <cstdint>
#include <string>

#include "calib/board/grey_picture.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scattermeter::FuzzFile file("a.png");
  const auto read = [](const std::string& path) {
    return scattermeter::calib::read_grey_picture(path, 0.05);
  };
  scattermeter::read_or_refuse(read, file.with(data, size));
  return 0;
}
