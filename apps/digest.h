// SHA-256.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

namespace scattermeter::apps {

// Of what is added, in order. Throws std::runtime_error where OpenSSL has no SHA-256.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;

  Digest& bytes(const void* data, std::size_t size);
  // With its length, so that neighbours cannot be mistaken for one another.
  Digest& text(std::string_view text);
  // Each bit counts: -0 and 0 differ.
  Digest& numbers(std::span<const double> numbers);
  Digest& number(double number) { return numbers({&number, 1}); }
  // Lower-case hexadecimal; to be called once.
  std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

// Of a file. Throws InputError naming it when it cannot be read.
std::string sha256_of_file(const std::string& path);

// Digests of files, each read once. For several threads at once.
class FileDigests {
 public:
  std::string of(const std::string& path);

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> known_;
};

}  // namespace scattermeter::apps
