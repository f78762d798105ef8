// Writing of a TIFF file, the door to libtiff.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <tiffio.h>

#include "capture/files/pending_file.h"
#include "capture/raw/ifd_bytes.h"

namespace scattermeter::capture {

// A file that appears under its path complete, by commit(), or not at all. A failure is remembered
// and reported by commit().
class TiffOutput {
 public:
  // `block` follows the header: its first byte is at kBlockOffset. libtiff appends everything else.
  TiffOutput(const std::string& path, ByteOrder order, const std::vector<std::uint8_t>& block);
  static constexpr std::uint32_t kBlockOffset = 8;

  // A field of the current directory, its values as TIFFSetField() takes them.
  template <typename... Values>
  void set(std::uint32_t tag, Values... values) {
    ok_ = ok_ && TIFFSetField(tiff_.get(), tag, values...) == 1;
  }
  // The only strip of the current directory, as it is stored. No bytes are swapped.
  void strip(std::vector<std::uint8_t> bytes);
  // Ends the current directory; the next one follows it, or is its first sub-directory if it has
  // the field TIFFTAG_SUBIFD.
  void end_directory();

  // Throws InputError naming the file when it cannot be written.
  void commit();

 private:
  struct Closer {
    void operator()(TIFF* tiff) const { TIFFCleanup(tiff); }  // leaves the descriptor open
  };

  std::string path_;
  PendingFile file_;
  std::string error_;  // the first of libtiff
  bool ok_ = true;
  std::unique_ptr<TIFF, Closer> tiff_;
};

}  // namespace scattermeter::capture
