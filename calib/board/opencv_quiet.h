// Suppression of the messages that OpenCV prints for the errors that it throws.
#pragma once

namespace scattermeter::calib {

// While an object of this class exists, cv::error() throws without writing to stderr. The error
// callback that achieves this is global to the process: the first object sets it, and the last one
// restores the previous callback. Any number of threads may have an object; a callback that a
// program sets in the meantime is lost.
class OpencvQuiet {
 public:
  OpencvQuiet();
  ~OpencvQuiet();
  OpencvQuiet(const OpencvQuiet&) = delete;
  OpencvQuiet& operator=(const OpencvQuiet&) = delete;
};

}  // namespace scattermeter::calib
