#include "calib/board/opencv_quiet.h"

#include <mutex>

#include <opencv2/core.hpp>

namespace scattermeter::calib {
namespace {

std::mutex& gate() {
  static std::mutex mutex;
  return mutex;
}

int holders = 0;
cv::ErrorCallback previous = nullptr;
void* previous_data = nullptr;

int say_nothing(int, const char*, const char*, const char*, int, void*) { return 0; }

}  // namespace

OpencvQuiet::OpencvQuiet() {
  const std::lock_guard<std::mutex> lock(gate());
  if (holders++ == 0) previous = cv::redirectError(&say_nothing, nullptr, &previous_data);
}

OpencvQuiet::~OpencvQuiet() {
  const std::lock_guard<std::mutex> lock(gate());
  if (--holders == 0) cv::redirectError(previous, previous_data);
}

}  // namespace scattermeter::calib
