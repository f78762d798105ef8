#include "apps/instrument/weight_folder.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

namespace scattermeter::apps {
namespace {

// The file: numbers of rows and columns, and the elements in single precision, row by row. Bytes as
// in memory.
using Shape = std::array<std::int64_t, 2>;
using Elements = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

std::string WeightFolder::bytes_of(const WeightMatrix& weights) const {
  const Shape shape{weights.rows(), weights.cols()};
  const Elements elements = weights.cast<float>();
  std::string out(reinterpret_cast<const char*>(shape.data()), sizeof shape);
  out.append(reinterpret_cast<const char*>(elements.data()),
             static_cast<std::size_t>(elements.size()) * sizeof(float));
  return out;
}

std::optional<WeightMatrix> WeightFolder::kept_in(std::string_view bytes) const {
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

}  // namespace scattermeter::apps
