#include "apps/instrument/weight_folder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include "apps/instrument/content_name.h"
#include "capture/files/checked_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".weights";

// The file: numbers of rows and columns, and the elements in single precision, row by row. Bytes as
// in memory.
using Shape = std::array<std::int64_t, 2>;
using Elements = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::string weights_as_bytes(const WeightMatrix& weights) {
  const Shape shape{weights.rows(), weights.cols()};
  const Elements elements = weights.cast<float>();
  std::string out(reinterpret_cast<const char*>(shape.data()), sizeof shape);
  out.append(reinterpret_cast<const char*>(elements.data()),
             static_cast<std::size_t>(elements.size()) * sizeof(float));
  return out;
}

std::optional<WeightMatrix> weights_of(std::string_view bytes) {
  Shape shape;
  if (bytes.size() < sizeof shape) return std::nullopt;
  std::memcpy(shape.data(), bytes.data(), sizeof shape);
  bytes.remove_prefix(sizeof shape);
  const auto [rows, columns] = shape;
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (rows < 0 || rows > kMost || columns < 0 || columns > kMost ||
      bytes.size() / sizeof(float) != static_cast<std::uint64_t>(rows * columns) ||
      bytes.size() % sizeof(float) != 0) {
    return std::nullopt;
  }
  Elements elements(rows, columns);
  std::memcpy(elements.data(), bytes.data(), bytes.size());
  return elements.cast<double>();
}

}  // namespace

WeightFolder::WeightFolder(std::string folder, std::uintmax_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {}

std::string WeightFolder::name(const std::vector<double>& numbers) const {
  return content_name(numbers);
}

std::string WeightFolder::path_of(const std::string& name) const {
  return folder_ + "/" + name + kEnding;
}

std::optional<WeightMatrix> WeightFolder::find(const std::string& name) {
  const std::string path = path_of(name);
  const auto content = capture::read_checked_file(path);
  if (!content) return std::nullopt;
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return weights_of(*content);
}

void WeightFolder::keep(const std::string& name, const WeightMatrix& weights) {
  std::string problem;
  try {
    capture::write_checked_file(path_of(name), weights_as_bytes(weights));
  } catch (const InputError& e) {
    problem = e.what();
  }
  const std::lock_guard lock(mutex_);
  if (problem_.empty()) problem_ = problem;
  remove_oldest();
}

void WeightFolder::remove_oldest() {
  std::error_code ignored;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    if (entry.path().extension() != kEnding) continue;
    // Another program may have removed it since.
    std::error_code gone;
    const std::uintmax_t size = entry.file_size(gone);
    const fs::file_time_type used = gone ? fs::file_time_type{} : entry.last_write_time(gone);
    if (gone) continue;
    bytes += size;
    files.emplace_back(used, entry.path());
  }
  if (bytes <= most_bytes_) return;
  std::sort(files.begin(), files.end());
  for (const auto& [used, path] : files) {
    if (bytes <= most_bytes_) return;
    const std::uintmax_t size = fs::file_size(path, ignored);
    if (!ignored && fs::remove(path, ignored)) bytes -= size;
  }
}

std::string WeightFolder::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

}  // namespace scattermeter::apps
