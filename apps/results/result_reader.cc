#include "apps/results/result_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "capture/files/file_text.h"
#include "core/base/input_error.h"
#include "core/base/nearest_name.h"

namespace scattermeter::apps {
namespace {

using ParsedJson = nlohmann::json;

constexpr double kNotTold = std::numeric_limits<double>::quiet_NaN();

// A value with its path for error messages.
class JsonField {
 public:
  JsonField(const ParsedJson& json, const std::string& file, std::string path)
      : json_(json), file_(file), path_(std::move(path)) {}

  JsonField at(const std::string& key) const {
    if (!json_.is_object()) fail("expected an object");
    const auto it = json_.find(key);
    const std::string path = path_.empty() ? key : path_ + "." + key;
    if (it == json_.end()) throw InputError(file_ + ": " + path, "is missing");
    return {*it, file_, path};
  }

  // A field that need not be there.
  std::optional<JsonField> find(const std::string& key) const {
    if (!json_.is_object() || !json_.contains(key)) return std::nullopt;
    return at(key);
  }

  std::vector<JsonField> items() const {
    if (!json_.is_array()) fail("expected a list");
    std::vector<JsonField> out;
    for (std::size_t i = 0; i < json_.size(); ++i) {
      out.emplace_back(json_[i], file_, fmt::format("{}[{}]", path_, i));
    }
    return out;
  }

  std::string text() const {
    if (!json_.is_string()) fail("expected text");
    return json_.get<std::string>();
  }

  // null: NaN, as result.json writes what is not known.
  double number() const {
    if (json_.is_null()) return kNotTold;
    if (!json_.is_number()) fail("expected a number or null");
    return json_.get<double>();
  }

  double number(double min, double max) const {
    const double value = number();
    if (!(value >= min && value <= max)) {
      fail(fmt::format("expected a number from {} to {}", min, max));
    }
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const {
    // A list or an object is named by its kind: dump() recurses as deep as the file nests.
    std::string got = json_.is_structured()
                          ? (json_.is_array() ? "a list" : "an object")
                          : json_.dump(-1, ' ', false, ParsedJson::error_handler_t::replace);
    if (got.size() > 60) got = got.substr(0, 60) + "...";
    throw InputError(file_ + ": " + path_, what + ", got " + got);
  }

 private:
  const ParsedJson& json_;
  const std::string& file_;
  std::string path_;
};

ParsedJson parse(const std::string& text, const std::string& path) {
  try {
    return ParsedJson::parse(text);
  } catch (const ParsedJson::parse_error& e) {
    const std::string read = text.substr(0, std::max<std::size_t>(e.byte, 1) - 1);
    throw InputError(path, fmt::format("is not JSON (line {}); give the result.json that `measure` "
                                       "has written",
                                       1 + std::count(read.begin(), read.end(), '\n')));
  } catch (const ParsedJson::out_of_range&) {
    throw InputError(path, fmt::format("holds a number beyond {:.2g}; give the result.json that "
                                       "`measure` has written",
                                       std::numeric_limits<double>::max()));
  }
}

Quantity read_quantity(const JsonField& field, bool refused, double min) {
  Quantity q;
  constexpr double kMost = 1e6;
  q.value = refused ? field.at("value").number() : field.at("value").number(min, kMost);
  q.std = field.at("std").number();
  const std::vector<JsonField> ends = field.at("interval95").items();
  if (ends.size() != 2) field.at("interval95").fail("expected two numbers");
  q.low95 = ends[0].number();
  q.high95 = ends[1].number();
  return q;
}

// The shift of the estimate by the least error that would be seen, per deviation of that error.
std::vector<RigResponse> read_responses(const JsonField& pulls) {
  std::vector<RigResponse> out;
  for (const JsonField& pull : pulls.items()) {
    const auto unseen = pull.find("unseen");
    const double least_in_std = unseen ? pull.at("least_seen_in_std").number() : 0.0;
    if (!(least_in_std > 0.0)) continue;
    const Eigen::Vector2d shift(unseen->at("sigma_s_prime_per_mm").number(),
                                unseen->at("sigma_a_per_mm").number());
    if (!shift.allFinite()) continue;
    out.push_back({pull.at("quantity").text(), pull.at("cause").text(), shift / least_in_std});
  }
  return out;
}

ReadChannel read_channel(const JsonField& field) {
  ReadChannel c;
  c.material = field.at("material").text();
  const std::string channel = field.at("channel").text();
  if (channel != "R" && channel != "G" && channel != "B") {
    field.at("channel").fail("expected R, G or B");
  }
  c.channel = channel[0];
  c.model = field.at("model").text();
  c.eta_int_over_ext = field.at("eta").number(0.1, 10.0);
  const std::string verdict = field.at("verdict").text();
  if (verdict != "ok" && verdict != "refused") {
    field.at("verdict").fail("expected ok or refused");
  }
  c.refused = verdict == "refused";
  for (const JsonField& reason : field.at("reasons").items()) c.reasons.push_back(reason.text());
  c.sigma_s_prime_per_mm = read_quantity(field.at("sigma_s_prime_per_mm"), c.refused, 1e-12);
  c.sigma_a_per_mm = read_quantity(field.at("sigma_a_per_mm"), c.refused, 0.0);
  c.correlation = field.at("correlation").number();
  if (const auto budget = field.find("budget")) {
    for (const JsonField& line : budget->items()) {
      c.budget.push_back({line.at("cause").text(), line.at("sigma_s_prime_per_mm").number(),
                          line.at("sigma_a_per_mm").number()});
    }
  }
  if (const auto pulls = field.find("pulls")) c.responses = read_responses(*pulls);
  return c;
}

}  // namespace

ReadResult read_result(const std::string& path) {
  const ParsedJson json = parse(
      capture::file_text(path, "the result.json that `measure` has written is expected"), path);
  if (json.is_object() && !json.contains("results")) {
    throw InputError(path, "has no results; give the result.json that `measure` has written");
  }
  const JsonField root(json, path, "");
  ReadResult result;
  result.path = path;
  result.version = root.at("version").text();
  result.command = root.at("command").text();
  if (const auto inputs = root.find("inputs")) {
    const std::vector<JsonField> files = inputs->items();
    if (!files.empty()) result.rig_sha256 = files.front().at("sha256").text();
  }
  std::set<std::pair<std::string, char>> seen;
  for (const JsonField& entry : root.at("results").items()) {
    const ReadChannel c = read_channel(entry);
    if (!seen.insert({c.material, c.channel}).second) {
      entry.at("channel").fail("material " + c.material + " has this channel twice");
    }
    result.channels.push_back(c);
  }
  if (result.channels.empty()) root.at("results").fail("expected at least one entry");
  return result;
}

std::vector<std::string> material_names(const ReadResult& result) {
  std::vector<std::string> out;
  for (const ReadChannel& c : result.channels) {
    if (std::find(out.begin(), out.end(), c.material) == out.end()) out.push_back(c.material);
  }
  return out;
}

void require_material(const ReadResult& result, const std::string& name) {
  const std::vector<std::string> all = material_names(result);
  if (std::find(all.begin(), all.end(), name) != all.end()) return;
  throw InputError(result.path, fmt::format("holds no material {}, only {}{}", name,
                                            fmt::join(all, ", "), did_you_mean(name, all)));
}

std::vector<MeasuredMaterial> materials_of(const ReadResult& result,
                                           const std::vector<std::string>& names) {
  for (const std::string& name : names) require_material(result, name);
  std::vector<MeasuredMaterial> out;
  for (const std::string& name : material_names(result)) {
    if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end()) continue;
    MeasuredMaterial m;
    m.name = name;
    for (std::size_t i = 0; i < 3; ++i) {
      const char channel = "RGB"[i];
      const auto it = std::find_if(
          result.channels.begin(), result.channels.end(),
          [&](const ReadChannel& c) { return c.material == name && c.channel == channel; });
      if (it == result.channels.end()) {
        throw InputError(result.path, "material " + name + " has no channel " + channel);
      }
      m.rgb[i] = *it;
    }
    m.eta_int_over_ext = m.rgb[0].eta_int_over_ext;
    for (const ReadChannel& c : m.rgb) {
      if (c.eta_int_over_ext != m.eta_int_over_ext) {
        throw InputError(result.path,
                         fmt::format("material {} has channels of different eta: {} and {}", name,
                                     m.eta_int_over_ext, c.eta_int_over_ext));
      }
    }
    out.push_back(m);
  }
  return out;
}

std::vector<std::string> names_of(const std::vector<MeasuredMaterial>& materials) {
  std::vector<std::string> names;
  for (const MeasuredMaterial& m : materials) names.push_back(m.name);
  return names;
}

std::vector<std::string> refusals(const std::vector<MeasuredMaterial>& materials) {
  std::vector<std::string> out;
  for (const MeasuredMaterial& m : materials) {
    for (const ReadChannel& c : m.rgb) {
      if (!c.refused) continue;
      std::string line = fmt::format("{} {} is refused", c.material, c.channel);
      if (!c.reasons.empty()) line += ": " + c.reasons.front();
      out.push_back(line);
    }
  }
  return out;
}

}  // namespace scattermeter::apps
