#include "apps/instrument/sample_map_folder.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string_view>

namespace scattermeter::apps {
namespace {

// A file that is no map.
struct NoMap {};

// Vectors one after the other, each behind its length. Bytes as in memory.
template <class T>
void append(const std::vector<T>& values, std::string& out) {
  const std::uint64_t size = values.size();
  out.append(reinterpret_cast<const char*>(&size), sizeof size);
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <class T>
std::vector<T> next(std::string_view& bytes) {
  std::uint64_t size = 0;
  if (bytes.size() < sizeof size) throw NoMap{};
  std::memcpy(&size, bytes.data(), sizeof size);
  bytes.remove_prefix(sizeof size);
  if (size > bytes.size() / sizeof(T)) throw NoMap{};
  std::vector<T> out(size);
  if (size > 0) std::memcpy(out.data(), bytes.data(), size * sizeof(T));
  bytes.remove_prefix(size * sizeof(T));
  return out;
}

// As next(), of so many.
template <class T>
std::vector<T> next(std::string_view& bytes, std::size_t size) {
  std::vector<T> out = next<T>(bytes);
  if (out.size() != size) throw NoMap{};
  return out;
}

constexpr std::size_t kOfSpread = 13;

void append(const SampleSpread& spread, std::vector<double>& out) {
  out.push_back(spread.share);
  out.insert(out.end(), spread.mean_mm.begin(), spread.mean_mm.end());
  const auto covariance = spread.covariance_mm2.reshaped();
  out.insert(out.end(), covariance.begin(), covariance.end());
}

SampleSpread spread_at(const std::vector<double>& numbers, std::size_t i) {
  const double* at = numbers.data() + kOfSpread * i;
  return {*at, Eigen::Map<const Eigen::Vector3d>(at + 1),
          Eigen::Map<const Eigen::Matrix3d>(at + 4)};
}

// Neighbouring samples of one row, or of none.
struct Run {
  std::int32_t row;
  std::uint32_t length;
};

std::vector<Run> runs_of(const std::vector<std::int32_t>& row_of_sample) {
  std::vector<Run> out;
  for (const std::int32_t row : row_of_sample) {
    if (out.empty() || out.back().row != row) out.push_back({row, 0});
    ++out.back().length;
  }
  return out;
}

// The sum of numbers none of which is negative.
std::size_t sum_of(const std::vector<std::int32_t>& counts) {
  std::size_t sum = 0;
  for (const std::int32_t n : counts) {
    if (n < 0) throw NoMap{};
    sum += static_cast<std::size_t>(n);
  }
  return sum;
}

// The rows of all samples, and the factors of those that have one.
void add_samples(const std::vector<Run>& runs, const std::vector<float>& factors,
                 std::size_t pixels, SampleMap& map) {
  std::uint64_t samples = 0;
  for (const Run& run : runs) samples += run.length;
  if (samples != pixels) throw NoMap{};
  map.row_of_sample.reserve(pixels);
  map.pi_over_transmittance.reserve(pixels);
  auto factor = factors.begin();
  for (const Run& run : runs) {
    map.row_of_sample.insert(map.row_of_sample.end(), run.length, run.row);
    if (run.row < 0) {
      map.pi_over_transmittance.insert(map.pi_over_transmittance.end(), run.length, 0.0F);
      continue;
    }
    if (factors.end() - factor < static_cast<std::ptrdiff_t>(run.length)) throw NoMap{};
    map.pi_over_transmittance.insert(map.pi_over_transmittance.end(), factor, factor + run.length);
    factor += run.length;
  }
  if (factor != factors.end()) throw NoMap{};
}

void require_within(const std::vector<std::int32_t>& rows, std::int32_t least, std::size_t end) {
  const bool within = std::all_of(rows.begin(), rows.end(), [&](std::int32_t row) {
    return row >= least && row < static_cast<std::int64_t>(end);
  });
  if (!within) throw NoMap{};
}

SampleMap map_of(std::string_view bytes) {
  SampleMap map;
  const std::vector<int> frame = next<int>(bytes, 4);
  map.x0 = frame[0];
  map.y0 = frame[1];
  map.width = frame[2];
  map.height = frame[3];
  if (map.width < 0 || map.height < 0) throw NoMap{};
  const auto counts = next<std::size_t>(bytes, 3);
  map.samples_on_object = counts[0];
  map.samples_guarded = counts[1];
  map.patches_partly_seen = counts[2];
  map.patch_of_row = next<int>(bytes);
  const std::size_t rows = map.patch_of_row.size();
  const std::size_t pixels =
      static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  const auto runs = next<Run>(bytes);
  add_samples(runs, next<float>(bytes), pixels, map);
  require_within(map.row_of_sample, -1, rows);
  map.coverage = next<double>(bytes, rows);
  map.guarded_of_row = next<std::size_t>(bytes, rows);
  const auto samples = next<double>(bytes, kOfSpread * rows);
  const auto n_quarters = next<std::int32_t>(bytes, rows);
  const auto of_quarters = next<double>(bytes, kOfSpread * sum_of(n_quarters));
  const auto n_adjacent = next<std::int32_t>(bytes, rows);
  const auto adjacent = next<std::int32_t>(bytes, sum_of(n_adjacent));
  require_within(adjacent, 0, rows);
  auto neighbour = adjacent.begin();
  for (std::size_t row = 0, quarter = 0; row < rows; ++row) {
    map.samples.push_back(spread_at(samples, row));
    auto& quarters = map.of_quarters.emplace_back();
    for (std::int32_t k = 0; k < n_quarters[row]; ++k) {
      quarters.push_back(spread_at(of_quarters, quarter++));
    }
    map.adjacent_rows.emplace_back(neighbour, neighbour + n_adjacent[row]);
    neighbour += n_adjacent[row];
  }
  return map;
}

}  // namespace

std::string SampleMapFolder::bytes_of(const SampleMap& map) const {
  std::vector<double> samples, of_quarters;
  std::vector<std::int32_t> n_quarters, n_adjacent, adjacent;
  for (const SampleSpread& s : map.samples) append(s, samples);
  for (const auto& quarters : map.of_quarters) {
    n_quarters.push_back(static_cast<std::int32_t>(quarters.size()));
    for (const SampleSpread& s : quarters) append(s, of_quarters);
  }
  for (const auto& rows : map.adjacent_rows) {
    n_adjacent.push_back(static_cast<std::int32_t>(rows.size()));
    adjacent.insert(adjacent.end(), rows.begin(), rows.end());
  }
  std::vector<float> factors;
  std::copy_if(map.pi_over_transmittance.begin(), map.pi_over_transmittance.end(),
               std::back_inserter(factors), [](float factor) { return factor != 0.0F; });
  std::string out;
  append(std::vector<int>{map.x0, map.y0, map.width, map.height}, out);
  append(
      std::vector<std::size_t>{map.samples_on_object, map.samples_guarded, map.patches_partly_seen},
      out);
  append(map.patch_of_row, out);
  append(runs_of(map.row_of_sample), out);
  append(factors, out);
  append(map.coverage, out);
  append(map.guarded_of_row, out);
  append(samples, out);
  append(n_quarters, out);
  append(of_quarters, out);
  append(n_adjacent, out);
  append(adjacent, out);
  return out;
}

std::optional<SampleMap> SampleMapFolder::kept_in(std::string_view bytes) const {
  try {
    return map_of(bytes);
  } catch (const NoMap&) {
    return std::nullopt;
  }
}

}  // namespace scattermeter::apps
