#include "capture/files/exr_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

class BytesStream : public Imf::IStream {
 public:
  BytesStream(const std::string& path, const std::string& bytes)
      : Imf::IStream(path.c_str()), bytes_(bytes) {}
  bool read(char c[], int n) override {
    const auto wanted = static_cast<std::size_t>(n);
    if (bytes_.size() - at_ < wanted) throw std::runtime_error("unexpected end of file");
    std::memcpy(c, bytes_.data() + at_, wanted);
    at_ += wanted;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t pos) override {
    if (pos > bytes_.size()) throw std::runtime_error("unexpected end of file");
    at_ = pos;
  }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

class StringStream : public Imf::OStream {
 public:
  StringStream() : Imf::OStream("memory") {}
  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (bytes_.size() < at_ + count) bytes_.resize(at_ + count);
    std::memcpy(bytes_.data() + at_, c, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t pos) override { at_ = pos; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

ProbeImage decode(const std::string& path, const std::string& bytes, const ProbeLimits& limits) {
  BytesStream stream(path, bytes);
  Imf::InputFile file(stream, 0);
  const Imath::Box2i data = file.header().dataWindow();
  if (data != file.header().displayWindow()) {
    throw InputError(path, "its data window differs from its display window: part of a picture?");
  }
  const auto width = static_cast<long long>(data.max.x) - data.min.x + 1;
  const auto height = static_cast<long long>(data.max.y) - data.min.y + 1;
  if (width < 1 || height < 1 || width > 1'000'000 || height > 1'000'000 ||
      static_cast<std::size_t>(width * height) > limits.max_pixels) {
    throw InputError(path, "is " + std::to_string(width) + " x " + std::to_string(height) +
                               " pixels, at most " + std::to_string(limits.max_pixels) +
                               " are allowed (limits.probe_megapixels of the rig)");
  }
  ProbeImage probe{static_cast<int>(width), static_cast<int>(height), {}};
  probe.radiance.resize(3 * static_cast<std::size_t>(width * height));
  const std::size_t pixel_bytes = 3 * sizeof(float);
  const std::size_t row_bytes = pixel_bytes * static_cast<std::size_t>(width);
  Imf::FrameBuffer frame;
  const std::array<const char*, 3> names = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const Imf::Channel* channel = file.header().channels().findChannel(names[c]);
    if (channel == nullptr) throw InputError(path, std::string("has no channel ") + names[c]);
    if (channel->type == Imf::UINT || channel->xSampling != 1 || channel->ySampling != 1) {
      throw InputError(path, std::string("channel ") + names[c] +
                                 " must be half or float with one value per pixel");
    }
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, probe.radiance.data() + c, data,
                                            pixel_bytes, row_bytes));
  }
  file.setFrameBuffer(frame);
  file.readPixels(data.min.y, data.max.y);
  return probe;
}

}  // namespace

std::string encode_exr(const ProbeImage& image, const std::map<std::string, std::string>& notes) {
  const auto pixels =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  if (image.width_px < 1 || image.height_px < 1 || image.radiance.size() != 3 * pixels) {
    throw std::invalid_argument("encode_exr: " + std::to_string(image.radiance.size()) +
                                " values for " + std::to_string(image.width_px) + " x " +
                                std::to_string(image.height_px));
  }
  Imf::Header header(image.width_px, image.height_px);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [name, text] : notes) header.insert(name, Imf::StringAttribute(text));
  // OpenEXR's slices are not const although writing a file only reads them.
  std::vector<float> values = image.radiance;
  const std::size_t pixel_bytes = 3 * sizeof(float);
  const std::size_t row_bytes = pixel_bytes * static_cast<std::size_t>(image.width_px);
  Imf::FrameBuffer frame;
  const std::array<const char*, 3> names = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, values.data() + c, header.dataWindow(),
                                            pixel_bytes, row_bytes));
  }
  StringStream stream;
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(frame);
    file.writePixels(image.height_px);
  }  // the destructor writes the line offset table
  return stream.bytes();
}

bool is_exr(const std::string& bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); }

ProbeImage decode_exr(const std::string& path, const std::string& bytes,
                      const ProbeLimits& limits) {
  try {
    return decode(path, bytes, limits);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    std::string what = e.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw InputError(path, "is damaged or truncated: " + what);
  }
}

}  // namespace scattermeter::capture
