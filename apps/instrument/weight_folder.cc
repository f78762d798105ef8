#include "apps/instrument/weight_folder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

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
  std::string bytes = weights_as_bytes(weights);
  const std::lock_guard lock(mutex_);
  waiting_.emplace_back(path_of(name), std::move(bytes));
}

std::string WeightFolder::write() {
  std::vector<std::pair<std::string, std::string>> files;
  {
    const std::lock_guard lock(mutex_);
    files.swap(waiting_);
  }
  if (files.empty()) return "";
  std::vector<std::string> problems(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    try {
      capture::write_checked_file(files[i].first, files[i].second);
    } catch (const InputError& e) {
      problems[i] = e.what();
    }
  });
  remove_oldest();
  const auto first = std::find_if(problems.begin(), problems.end(),
                                  [](const std::string& p) { return !p.empty(); });
  return first == problems.end() ? "" : *first;
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

}  // namespace scattermeter::apps
