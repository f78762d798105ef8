// SHA-256 digests of data and files.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

namespace scattermeter::capture {

// The SHA-256 of everything added, in order. Throws std::runtime_error if OpenSSL has no SHA-256.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;

  Digest& bytes(const void* data, std::size_t size);
  // Adds the length, too, so that different sequences of texts cannot give the same bytes.
  Digest& text(std::string_view text);
  // Adds the bit patterns: -0 and 0 differ.
  Digest& numbers(std::span<const double> numbers);
  Digest& number(double number) { return numbers({&number, 1}); }
  // The digest in lower-case hexadecimal. May be called only once.
  std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

// The SHA-256 of a file. Throws InputError naming the file when it cannot be read.
std::string sha256_of_file(const std::string& path);

// Digests of files, each of which is read only once. Safe to use from several threads.
class FileDigests {
 public:
  std::string of(const std::string& path);
  // The file is to be read again.
  void forget(const std::string& path);

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> known_;
};

}  // namespace scattermeter::capture
