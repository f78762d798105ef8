#include "capture/files/digest.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>
#include <openssl/evp.h>

#include "core/base/input_error.h"

namespace scattermeter::capture {

struct Digest::Context {
  EVP_MD_CTX* evp = EVP_MD_CTX_new();
  ~Context() { EVP_MD_CTX_free(evp); }
};

Digest::Digest() : context_(std::make_unique<Context>()) {
  if (context_->evp == nullptr || EVP_DigestInit_ex(context_->evp, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("Digest: OpenSSL has no SHA-256");
  }
}

Digest::~Digest() = default;

Digest& Digest::bytes(const void* data, std::size_t size) {
  EVP_DigestUpdate(context_->evp, data, size);
  return *this;
}

Digest& Digest::text(std::string_view text) {
  const std::uint64_t size = text.size();
  return bytes(&size, sizeof size).bytes(text.data(), text.size());
}

Digest& Digest::numbers(std::span<const double> numbers) {
  return bytes(numbers.data(), numbers.size_bytes());
}

std::string Digest::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  EVP_DigestFinal_ex(context_->evp, digest.data(), &size);
  std::string hex;
  for (unsigned i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

std::string sha256_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw MissingFile(path, "cannot be opened");
  Digest digest;
  std::vector<char> block(1 << 20);
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    digest.bytes(block.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) throw InputError(path, "cannot be read to its end");
  return digest.hex();
}

std::string FileDigests::of(const std::string& path) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto it = known_.find(path); it != known_.end()) return it->second;
  }
  std::string digest = sha256_of_file(path);
  const std::lock_guard lock(mutex_);
  return known_[path] = std::move(digest);
}

void FileDigests::forget(const std::string& path) {
  const std::lock_guard lock(mutex_);
  known_.erase(path);
}

}  // namespace scattermeter::capture
