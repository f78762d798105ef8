#include "apps/pages/packed_integers.h"

#include <cstddef>
#include <stdexcept>

#include <zlib.h>

#include "apps/pages/base64.h"

namespace scattermeter::apps {
namespace {

// Pages are 2 % larger than at the best level; compressing takes an eighth of the time.
constexpr int kLevel = 4;

}  // namespace

std::string packed_integers(const std::vector<std::int32_t>& values, int bytes) {
  std::vector<Bytef> planes;
  planes.reserve(values.size() * static_cast<std::size_t>(bytes));
  for (int plane = 0; plane < bytes; ++plane) {
    for (const std::int32_t v : values) {
      planes.push_back(static_cast<Bytef>(static_cast<std::uint32_t>(v) >> (8 * plane) & 0xFFU));
    }
  }
  uLongf size = compressBound(planes.size());
  std::vector<Bytef> out(size);
  if (compress2(out.data(), &size, planes.data(), planes.size(), kLevel) != Z_OK) {
    throw std::runtime_error("zlib cannot compress the data of a page");
  }
  return base64({out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size)});
}

}  // namespace scattermeter::apps
