// What is kept of a jig in a folder.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/instrument/content_name.h"
#include "core/base/kept_store.h"

namespace scattermeter::apps {

// Files FOLDER/NAME.ENDING. What is to be kept waits for write(), so that a measurement that fails
// leaves nothing behind. A file appears complete or not at all, and one with a wrong digest is
// ignored. Of more than most_bytes, the files that were not used for longest are removed.
class KeptFolder {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30;
  // ending: with its dot.
  KeptFolder(std::string folder, std::string ending, std::uintmax_t most_bytes = kMostBytes);

  std::optional<std::string> find(const std::string& name);
  void keep(const std::string& name, std::string bytes);

  // Writes all that waits. Returns why the first that failed did; "" if none.
  std::string write();

 private:
  std::string path_of(const std::string& name) const;
  void remove_oldest();

  std::string folder_, ending_;
  std::uintmax_t most_bytes_;
  std::mutex mutex_;
  std::vector<std::pair<std::string, std::string>> waiting_;  // paths and contents
};

// A KeptStore in such a folder.
template <class Kept>
class FolderStore : public KeptStore<Kept> {
 public:
  std::string name(const std::vector<double>& numbers) const override {
    return content_name(numbers);
  }
  std::optional<Kept> find(const std::string& name) override {
    const std::optional<std::string> bytes = files_.find(name);
    return bytes ? kept_in(*bytes) : std::nullopt;
  }
  void keep(const std::string& name, const Kept& kept) override {
    files_.keep(name, bytes_of(kept));
  }
  std::string write() { return files_.write(); }  // KeptFolder::write()

 protected:
  FolderStore(std::string folder, std::string ending)
      : files_(std::move(folder), std::move(ending)) {}

 private:
  virtual std::string bytes_of(const Kept& kept) const = 0;
  // nullopt: not the bytes of one.
  virtual std::optional<Kept> kept_in(std::string_view bytes) const = 0;

  KeptFolder files_;
};

}  // namespace scattermeter::apps
