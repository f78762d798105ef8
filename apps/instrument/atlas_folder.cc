#include "apps/instrument/atlas_folder.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include "apps/instrument/content_name.h"
#include "capture/files/checked_file.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

// Waits until no other program holds it; held until destroyed, or until the program ends.
class FileLock {
 public:
  explicit FileLock(const std::string& path)
      : descriptor_(open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666)) {
    // A file system without locks: the last to write wins.
    if (descriptor_ >= 0) static_cast<void>(flock(descriptor_, LOCK_EX));
  }
  ~FileLock() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

// The earliest time if there is no such file.
fs::file_time_type changed(const std::string& path) {
  std::error_code none;
  const fs::file_time_type at = fs::last_write_time(path, none);
  return none ? fs::file_time_type::min() : at;
}

std::string center_name(const Eigen::Vector3d& center_mm) {
  return fmt::format("{},{},{}", center_mm.x(), center_mm.y(), center_mm.z());
}

std::optional<Eigen::Vector3d> center_of(std::string_view name) {
  Eigen::Vector3d out;
  const char* at = name.data();
  const char* const end = at + name.size();
  for (int i = 0; i < 3; ++i) {
    if (i > 0 && (at == end || *at++ != ',')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, out[i]);
    if (error != std::errc()) return std::nullopt;
    at = next;
  }
  return at == end ? std::optional(out) : std::nullopt;
}

// The file: six counts, the sums, their changes by eta, and of each kept tilt the steps' sizes and
// the batches in steps. Bytes as in memory.
constexpr std::int64_t kFormat = 5;
using Counts = std::array<std::int64_t, 6>;

template <class T>
void append(std::string& out, const T* values, Eigen::Index n) {
  out.append(reinterpret_cast<const char*>(values), static_cast<std::size_t>(n) * sizeof(T));
}

std::string packed(const WhiteSums& sums) {
  const PackedBatches& batches = sums.batches;
  const Counts counts = {kFormat,
                         sums.levels,
                         sums.sum.rows(),
                         sums.sum.cols(),
                         static_cast<std::int64_t>(batches.steps.size()),
                         batches.steps.empty() ? 0 : batches.steps.front().rows()};
  std::string out;
  append(out, counts.data(), static_cast<Eigen::Index>(counts.size()));
  append(out, sums.sum.data(), sums.sum.size());
  append(out, sums.per_eta.data(), sums.per_eta.size());
  for (std::size_t t = 0; t < batches.steps.size(); ++t) {
    append(out, batches.step_of[t].data(), batches.step_of[t].size());
    append(out, batches.steps[t].data(), batches.steps[t].size());
  }
  return out;
}

std::optional<WhiteSums> unpacked(std::string_view bytes) {
  Counts counts;
  if (bytes.size() < sizeof counts) return std::nullopt;
  std::memcpy(counts.data(), bytes.data(), sizeof counts);
  const auto [format, levels, tilts, rows, batches, batch_rows] = counts;
  if (format != kFormat) return std::nullopt;
  constexpr std::int64_t kMost = std::int64_t{1} << 31;
  for (const std::int64_t n : counts) {
    if (n < 0 || n > kMost) return std::nullopt;
  }
  const auto n_rows = static_cast<double>(rows);
  const double expected =
      sizeof counts + 8.0 * static_cast<double>(tilts) * n_rows +
      (8.0 + static_cast<double>(batch_rows)) * static_cast<double>(batches) * n_rows;
  if (static_cast<double>(bytes.size()) != expected) return std::nullopt;
  WhiteSums out;
  out.levels = static_cast<int>(levels);
  const char* at = bytes.data() + sizeof counts;
  const auto fill = [&](auto& matrix) {
    const std::size_t size = static_cast<std::size_t>(matrix.size()) * sizeof *matrix.data();
    std::memcpy(matrix.data(), at, size);
    at += size;
  };
  out.sum.resize(tilts, rows);
  fill(out.sum);
  out.per_eta.resize(batches, rows);
  fill(out.per_eta);
  out.batches = PackedBatches(static_cast<std::size_t>(batches), batch_rows, rows);
  for (std::size_t t = 0; t < out.batches.steps.size(); ++t) {
    fill(out.batches.step_of[t]);
    fill(out.batches.steps[t]);
  }
  return out;
}

}  // namespace

std::string AtlasFolder::name(const std::vector<double>& numbers) const {
  return content_name(numbers);
}

std::string AtlasFolder::folder_of(const std::string& body) const { return folder_ + "/" + body; }

std::string AtlasFolder::path_of(const std::string& body, const Eigen::Vector3d& center_mm,
                                 int node) const {
  return fmt::format("{}/{}/{}.paths", folder_of(body), center_name(center_mm), node);
}

std::vector<Eigen::Vector3d> AtlasFolder::centers_mm(const std::string& body) {
  std::vector<Eigen::Vector3d> out;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_of(body), ignored)) {
    if (const auto center = center_of(entry.path().filename().string())) out.push_back(*center);
  }
  return out;
}

std::optional<WhiteSums> AtlasFolder::find(const std::string& body,
                                           const Eigen::Vector3d& center_mm, int node) {
  const std::string path = path_of(body, center_mm, node);
  const fs::file_time_type at = changed(path);
  const auto content = capture::read_checked_file(path);
  auto sums = content ? unpacked(*content) : std::nullopt;
  seen_[path] = {at, sums ? sums->levels : 0};
  return sums;
}

void AtlasFolder::keep(const std::string& body, const Eigen::Vector3d& center_mm, int node,
                       const WhiteSums& sums) {
  const std::string path = path_of(body, center_mm, node);
  try {
    capture::make_folder_of(path);
    const FileLock lock(folder_of(body) + "/lock");
    // Read again only if another program has written it.
    if (const auto seen = seen_.find(path);
        seen == seen_.end() || seen->second.at != changed(path)) {
      find(body, center_mm, node);
    }
    if (seen_.at(path).levels >= sums.levels) return;
    capture::write_checked_file(path, packed(sums));
    seen_[path] = {changed(path), sums.levels};
  } catch (const InputError& e) {
    if (problem_.empty()) problem_ = e.what();
  }
}

}  // namespace scattermeter::apps
