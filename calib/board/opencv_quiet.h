// Keeps OpenCV from printing the errors that it also throws.
#pragma once

namespace scattermeter::calib {

// While one lives, cv::error() throws without writing to stderr. The callback that does so belongs
// to the whole process: the first object sets it, the last one puts back what was there. Any number
// of threads may hold one; a program that sets a callback of its own meanwhile loses it.
class OpencvQuiet {
 public:
  OpencvQuiet();
  ~OpencvQuiet();
  OpencvQuiet(const OpencvQuiet&) = delete;
  OpencvQuiet& operator=(const OpencvQuiet&) = delete;
};

}  // namespace scattermeter::calib
