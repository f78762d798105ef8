#include "apps/pages/residual_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>
#include <oneapi/tbb/parallel_for.h>

#include "apps/pages/html_page.h"
#include "apps/pages/packed_integers.h"
#include "apps/pages/page_number.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kObservedStep_percent = 0.01;  // of the brightest row in use
constexpr double kDifferenceStep = 0.01;        // of the full scale
// Of a row in one channel of one shot, as packed in base64, with its share of the map (measured on
// the sample).
constexpr std::size_t kBytesPerRow = 5;

double brightest_of(const ShotRows& rows) {
  double out = 0.0;
  for (std::size_t j = 0; j < rows.observed.size(); ++j) {
    if (rows.state[j] == RowState::kUsed) out = std::max<double>(out, rows.observed[j]);
  }
  return out;
}

// A round number of percent that most of the differences do not exceed.
double round_up(double percent) {
  for (const double step : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (percent <= step) return step;
  }
  return 100.0;
}

// Which row is seen at each place of a reduced picture of the map's rectangle.
Json map_data(const SampleMap& map, int width_px) {
  const int step = std::max(1, (map.width + width_px - 1) / width_px);
  const int width = map.width / step, height = map.height / step;
  std::vector<std::int32_t> rows;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto at =
          static_cast<std::size_t>(y * step + step / 2) * static_cast<std::size_t>(map.width) +
          static_cast<std::size_t>(x * step + step / 2);
      rows.push_back(map.row_of_sample[at] + 1);
    }
  }
  return {{"x0", map.x0},   {"y0", map.y0},     {"step", step},
          {"width", width}, {"height", height}, {"rows", packed_integers(rows, 3)}};
}

Json shot_data(const ChannelShot& shot, std::ptrdiff_t map_idx, double full_scale_percent) {
  const ShotRows& rows = *shot.rows;
  const double brightest = brightest_of(rows);
  const auto steps = [&](double value, double step_percent) {
    const double n = 100.0 * value / (brightest * step_percent);
    return std::isfinite(n)
               ? static_cast<std::int32_t>(std::lround(std::clamp(n, -32767.0, 32767.0)))
               : 0;
  };
  std::vector<std::int32_t> observed, difference, state;
  for (std::size_t j = 0; j < rows.observed.size(); ++j) {
    observed.push_back(steps(rows.observed[j], kObservedStep_percent));
    difference.push_back(steps(static_cast<double>(rows.observed[j]) - rows.predicted[j],
                               kDifferenceStep * full_scale_percent));
    state.push_back(static_cast<std::int32_t>(rows.state[j]));
  }
  return {{"file", plain_text(rows.file)},
          {"channel", std::string(1, shot.channel)},
          {"map", map_idx},
          {"rms_percent", page_number(100.0 * relative_rms(rows))},
          {"observed", packed_integers(observed, 2)},
          {"difference", packed_integers(difference, 2)},
          {"state", packed_integers(state, 1)}};
}

}  // namespace

double difference_scale_percent(const ShotRows& rows) {
  std::vector<double> differences;
  for (std::size_t j = 0; j < rows.observed.size(); ++j) {
    if (rows.state[j] == RowState::kUsed) {
      differences.push_back(std::abs(static_cast<double>(rows.observed[j] - rows.predicted[j])));
    }
  }
  const double brightest = brightest_of(rows);
  if (differences.empty() || !(brightest > 0.0)) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(differences.size() - 1));
  std::nth_element(differences.begin(), differences.begin() + at, differences.end());
  return round_up(100.0 * differences[static_cast<std::size_t>(at)] / brightest);
}

double relative_rms(const ShotRows& rows) {
  double squares = 0.0, light = 0.0;
  for (std::size_t j = 0; j < rows.observed.size(); ++j) {
    if (rows.state[j] != RowState::kUsed) continue;
    const double o = rows.observed[j];
    const double d = o - static_cast<double>(rows.predicted[j]);
    squares += d * d;
    light += o * o;
  }
  return light > 0.0 ? std::sqrt(squares / light) : 0.0;
}

std::vector<ChannelShot> shots_to_map(const std::vector<const ChannelResult*>& channels,
                                      std::size_t most_bytes) {
  std::map<std::string, double> worst;  // of each shot's channels
  std::size_t bytes = 0;
  for (const ChannelResult* r : channels) {
    for (const ShotRows& rows : r->rows) {
      double& of_shot = worst[rows.file];
      of_shot = std::max(of_shot, relative_rms(rows));
      bytes += kBytesPerRow * rows.observed.size();
    }
  }
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [file, rms] : worst) order.emplace_back(-rms, file);
  std::sort(order.begin(), order.end());
  const std::size_t shown = bytes <= most_bytes
                                ? order.size()
                                : std::max<std::size_t>(1, order.size() * most_bytes / bytes);
  std::set<std::string> files;
  for (std::size_t i = 0; i < shown && i < order.size(); ++i) files.insert(order[i].second);
  std::vector<ChannelShot> out;
  for (const ChannelResult* r : channels) {
    for (const ShotRows& rows : r->rows) {
      if (files.contains(rows.file)) out.push_back({&rows, r->channel});
    }
  }
  return out;
}

std::string residual_map_data(const std::vector<ChannelShot>& shots, int width_px,
                              double full_scale_percent) {
  std::vector<const SampleMap*> maps;
  std::vector<Json> of_shot(shots.size());
  for (const ChannelShot& shot : shots) {
    const SampleMap* map = shot.rows->map.get();
    if (std::find(maps.begin(), maps.end(), map) == maps.end()) maps.push_back(map);
  }
  std::vector<Json> of_map(maps.size());
  tbb::parallel_for(std::size_t{0}, maps.size(),
                    [&](std::size_t i) { of_map[i] = map_data(*maps[i], width_px); });
  tbb::parallel_for(std::size_t{0}, shots.size(), [&](std::size_t i) {
    const auto map = std::find(maps.begin(), maps.end(), shots[i].rows->map.get());
    of_shot[i] = shot_data(shots[i], map - maps.begin(), full_scale_percent);
  });
  return Json{{"full_scale_percent", full_scale_percent}, {"maps", of_map}, {"shots", of_shot}}
      .dump();
}

}  // namespace scattermeter::apps
