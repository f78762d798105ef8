#include "capture/files/checked_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "capture/files/digest.h"
#include "capture/files/pending_file.h"

namespace scattermeter::capture {
namespace {

constexpr std::size_t kDigestLength = 64;

std::string digest_of(std::string_view content) {
  return Digest().bytes(content.data(), content.size()).hex();
}

}  // namespace

std::optional<std::string> read_checked_file(const std::string& path) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(path, none);
  if (none || size < kDigestLength) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  std::string digest(kDigestLength, '\0');
  std::string content(static_cast<std::size_t>(size) - kDigestLength, '\0');
  if (!in.read(digest.data(), kDigestLength) ||
      !in.read(content.data(), static_cast<std::streamsize>(content.size())) ||
      digest_of(content) != digest) {
    return std::nullopt;
  }
  return content;
}

void write_checked_file(const std::string& path, std::string_view content) {
  write_text_file(path, digest_of(content).append(content));
}

}  // namespace scattermeter::capture
