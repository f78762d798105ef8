#include "capture/raw/tiff_output.h"

#include <array>
#include <cstdarg>
#include <cstdio>

#include <unistd.h>

#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

// Replaces libtiff's default handler, which prints; keeps the first error for the exception.
int keep_error(TIFF* /*tiff*/, void* message, const char* /*module*/, const char* format,
               va_list arguments) {
  auto& text = *static_cast<std::string*>(message);
  if (text.empty()) {
    std::array<char, 256> buffer{};
    std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
    text = buffer.data();
  }
  return 1;
}

int drop_warning(TIFF* /*tiff*/, void* /*user*/, const char* /*module*/, const char* /*format*/,
                 va_list /*arguments*/) {
  return 1;
}

struct OptionsFree {
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

}  // namespace

TiffOutput::TiffOutput(const std::string& path, ByteOrder order,
                       const std::vector<std::uint8_t>& block)
    : path_(path), file_(path) {
  const std::unique_ptr<TIFFOpenOptions, OptionsFree> options(TIFFOpenOptionsAlloc());
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_error, &error_);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), drop_warning, nullptr);
  // The byte order is stated, so that all machines write the same bytes.
  const char* mode = order == ByteOrder::kLittleEndian ? "wl" : "wb";
  tiff_.reset(TIFFFdOpenExt(file_.descriptor(), path.c_str(), mode, options.get()));
  // libtiff writes the header when it opens the file.
  ok_ = tiff_ != nullptr && ::pwrite(file_.descriptor(), block.data(), block.size(),
                                     kBlockOffset) == static_cast<ssize_t>(block.size());
}

void TiffOutput::strip(std::vector<std::uint8_t> bytes) {
  const auto size = static_cast<tmsize_t>(bytes.size());
  ok_ = ok_ && TIFFWriteRawStrip(tiff_.get(), 0, bytes.data(), size) == size;
}

void TiffOutput::end_directory() { ok_ = ok_ && TIFFWriteDirectory(tiff_.get()) == 1; }

void TiffOutput::commit() {
  tiff_.reset();
  if (!ok_)
    throw InputError(path_, "cannot be written: " + (error_.empty() ? "libtiff failed" : error_));
  file_.commit();
}

}  // namespace scattermeter::capture
