#include "capture/shots/decoded_shot.h"

#include <cstring>

#include <nlohmann/json.hpp>

namespace scattermeter::capture {
namespace {

using Json = nlohmann::json;

// Builds the tree of the parsed values, but no deeper than that of a shot: the parser recurses at
// each level, and a file of nothing but opening brackets would overflow the stack.
class ShallowTree : public nlohmann::detail::json_sax_dom_parser<Json> {
 public:
  explicit ShallowTree(Json& whole) : json_sax_dom_parser(whole, false) {}
  bool start_object(std::size_t n) { return deeper() && json_sax_dom_parser::start_object(n); }
  bool start_array(std::size_t n) { return deeper() && json_sax_dom_parser::start_array(n); }
  bool end_object() {
    --depth_;
    return json_sax_dom_parser::end_object();
  }
  bool end_array() {
    --depth_;
    return json_sax_dom_parser::end_array();
  }

 private:
  static constexpr int kDepth = 8;
  bool deeper() { return ++depth_ <= kDepth; }
  int depth_ = 0;
};

// Every value must be present and of the right type; anything else is not a shot.
struct NoShot {};

template <class T>
Json packed(const std::vector<T>& values) {
  Json::binary_t out;
  out.resize(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(out.data(), values.data(), out.size());
  return Json(std::move(out));
}

const Json& at(const Json& j, const char* name) {
  const auto it = j.is_object() ? j.find(name) : j.end();
  if (it == j.end()) throw NoShot{};
  return *it;
}

template <class T>
std::vector<T> unpacked(const Json& j) {
  if (!j.is_binary() || j.get_binary().size() % sizeof(T) != 0) throw NoShot{};
  std::vector<T> out(j.get_binary().size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), j.get_binary().data(), out.size() * sizeof(T));
  return out;
}

// Nothing where it was not looked for, one number where it was in vain.
std::vector<double> numbers_of(const std::optional<EdgeBlur>& blur) {
  if (!blur) return {};
  if (!blur->is_measured) return {0.0};
  return {blur->mm2(0, 0), blur->mm2(0, 1), blur->mm2(1, 1)};
}

std::optional<EdgeBlur> blur_of(const std::vector<double>& n) {
  if (n.empty()) return std::nullopt;
  if (n.size() == 1) return EdgeBlur{};
  if (n.size() != 3) throw NoShot{};
  return EdgeBlur{true, Eigen::Matrix2d{{n[0], n[1]}, {n[1], n[2]}}};
}

double number(const Json& j) {
  if (!j.is_number()) throw NoShot{};
  return j.get<double>();
}

std::size_t count(const Json& j) {
  if (!j.is_number_unsigned()) throw NoShot{};
  return j.get<std::size_t>();
}

const Json& list(const Json& j) {
  if (!j.is_array()) throw NoShot{};
  return j;
}

std::vector<unsigned char> states(const ChannelObservation& o) {
  std::vector<unsigned char> out;
  out.reserve(o.state.size());
  for (const RowState s : o.state) out.push_back(static_cast<unsigned char>(s));
  return out;
}

Json channel_json(const ChannelObservation& o) {
  Json parts = Json::array();
  for (const ExposurePart& p : o.exposures) {
    parts.push_back({{"of_row", packed(p.of_row)}, {"samples", p.samples}});
  }
  return {{"l", packed(o.l)},
          {"variance", packed(o.variance)},
          {"variance_per_l", packed(o.variance_per_l)},
          {"l_per_count", packed(o.l_per_count)},
          {"state", packed(states(o))},
          {"rows_used", o.rows_used},
          {"rows_clipped", o.rows_clipped},
          {"rows_floor", o.rows_floor},
          {"samples", o.samples},
          {"samples_clipped", o.samples_clipped},
          {"brightest_counts", o.brightest_counts},
          {"brightest_snr", o.brightest_snr},
          {"noise_excess", o.noise_excess},
          {"exposures", parts}};
}

ChannelObservation channel_of(const Json& j) {
  ChannelObservation o;
  o.l = unpacked<double>(at(j, "l"));
  o.variance = unpacked<double>(at(j, "variance"));
  o.variance_per_l = unpacked<double>(at(j, "variance_per_l"));
  o.l_per_count = unpacked<double>(at(j, "l_per_count"));
  std::size_t used = 0;
  for (const unsigned char s : unpacked<unsigned char>(at(j, "state"))) {
    if (s >= kRowStates) throw NoShot{};
    o.state.push_back(static_cast<RowState>(s));
    used += o.state.back() == RowState::kUsed ? 1 : 0;
  }
  o.rows_used = count(at(j, "rows_used"));
  o.rows_clipped = count(at(j, "rows_clipped"));
  o.rows_floor = count(at(j, "rows_floor"));
  o.samples = count(at(j, "samples"));
  o.samples_clipped = count(at(j, "samples_clipped"));
  o.brightest_counts = number(at(j, "brightest_counts"));
  o.brightest_snr = number(at(j, "brightest_snr"));
  o.noise_excess = number(at(j, "noise_excess"));
  for (const Json& p : list(at(j, "exposures"))) {
    o.exposures.push_back({unpacked<double>(at(p, "of_row")), count(at(p, "samples"))});
    if (o.exposures.back().of_row.size() != o.l.size()) throw NoShot{};
  }
  const std::size_t rows = o.l.size();
  if (o.variance.size() != rows || o.variance_per_l.size() != rows ||
      o.l_per_count.size() != rows || o.state.size() != rows || o.rows_used != used) {
    throw NoShot{};
  }
  return o;
}

}  // namespace

std::vector<std::uint8_t> to_bytes(const DecodedShot& shot) {
  Json channels = Json::array();
  for (const ChannelObservation& o : shot.observation.channel) channels.push_back(channel_json(o));
  Json exposures = Json::array();
  for (const ShotExposure& e : shot.exposures) {
    // A departure may be NaN; packing preserves its bits.
    std::vector<double> numbers{e.stated_s,
                                e.true_s,
                                e.relative_std,
                                e.black_std_counts,
                                e.departure.log_ratio,
                                e.departure.noise_std,
                                e.departure.mean_counts};
    numbers.insert(numbers.end(), e.pedestal_counts.begin(), e.pedestal_counts.end());
    numbers.insert(numbers.end(), e.pedestal_std_counts.begin(), e.pedestal_std_counts.end());
    numbers.insert(numbers.end(), e.beside_counts.begin(), e.beside_counts.end());
    exposures.push_back({{"file", e.file}, {"numbers", packed(numbers)}});
  }
  const auto& mean = shot.frame_mean_counts;
  return Json::to_cbor(
      {{"channels", channels},
       {"exposure_s", shot.exposure_s},
       {"iso", shot.iso},
       {"f_number", shot.f_number},
       {"edge_blur_mm2", packed(numbers_of(shot.edge_blur))},
       {"exposures", exposures},
       {"frame_mean_counts", packed(std::vector<double>(mean.begin(), mean.end()))}});
}

std::optional<DecodedShot> decoded_shot(std::span<const std::uint8_t> bytes) {
  try {
    Json j;
    ShallowTree tree(j);
    if (!Json::sax_parse(bytes.begin(), bytes.end(), &tree, Json::input_format_t::cbor)) {
      return std::nullopt;
    }
    DecodedShot shot;
    const Json& channels = list(at(j, "channels"));
    if (channels.size() != kRgb) throw NoShot{};
    for (std::size_t c = 0; c < kRgb; ++c) {
      shot.observation.channel[c] = channel_of(channels[c]);
      if (shot.observation.channel[c].l.size() != shot.observation.channel[0].l.size()) {
        throw NoShot{};
      }
    }
    shot.exposure_s = number(at(j, "exposure_s"));
    shot.iso = number(at(j, "iso"));
    shot.f_number = number(at(j, "f_number"));
    shot.edge_blur = blur_of(unpacked<double>(at(j, "edge_blur_mm2")));
    for (const Json& e : list(at(j, "exposures"))) {
      const Json& file = at(e, "file");
      const std::vector<double> n = unpacked<double>(at(e, "numbers"));
      if (!file.is_string() || n.size() != 16) throw NoShot{};
      shot.exposures.push_back({file.get<std::string>(),
                                n[0],
                                n[1],
                                n[2],
                                n[3],
                                {n[4], n[5], n[6]},
                                {n[7], n[8], n[9]},
                                {n[10], n[11], n[12]},
                                {n[13], n[14], n[15]}});
    }
    for (const ChannelObservation& o : shot.observation.channel) {
      if (!o.exposures.empty() && o.exposures.size() != shot.exposures.size()) throw NoShot{};
    }
    const std::vector<double> mean = unpacked<double>(at(j, "frame_mean_counts"));
    if (mean.size() != kRgb) throw NoShot{};
    std::copy(mean.begin(), mean.end(), shot.frame_mean_counts.begin());
    return shot;
  } catch (const NoShot&) {
    return std::nullopt;
  } catch (const Json::exception&) {
    // For a list that claims an impossible length the parser throws even when told not to.
    return std::nullopt;
  }
}

}  // namespace scattermeter::capture
