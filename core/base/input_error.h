// A user's mistake: a file, a field or a value that cannot be used.
#pragma once

#include <stdexcept>
#include <string>

namespace scattermeter {

// The one exception type for bad input. `what()` is a whole sentence for the user and
// names the file, the field (where there is one) and the offending value, in this order:
//   "rig.yaml:12: camera.image_size_px: expected two positive integers, got [0, 2592]"
// The program prints it and exits with status 2. Broken preconditions between our own functions
// are std::invalid_argument instead and mean a defect.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  InputError(const std::string& where, const std::string& what)
      : std::runtime_error(where + ": " + what) {}
};

// A file or folder that is not there.
class MissingFile : public InputError {
 public:
  using InputError::InputError;
};

// Rethrows the error, prefixed with the location where the file was named.
[[noreturn]] inline void rethrow_at(const std::string& where, const InputError& error) {
  if (dynamic_cast<const MissingFile*>(&error) != nullptr) throw MissingFile(where, error.what());
  throw InputError(where, error.what());
}

}  // namespace scattermeter
