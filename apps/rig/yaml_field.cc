#include "apps/rig/yaml_field.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "capture/files/file_kind.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

// The value on one line, shortened if it is long.
std::string shown(const YAML::Node& node) {
  if (!node || node.IsNull()) return "nothing";
  YAML::Emitter out;
  out.SetMapFormat(YAML::Flow);
  out.SetSeqFormat(YAML::Flow);
  out << node;
  std::string text = out.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  constexpr std::size_t kLongest = 80;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

}  // namespace

YamlField::YamlField(const YAML::Node& node, std::string file, std::string path)
    : node_(node), file_(std::move(file)), path_(std::move(path)) {}

YamlField YamlField::load(const std::string& file) {
  if (capture::is_folder(file)) throw InputError(file, "is a folder, not a rig file");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw MissingFile(file, "the rig file cannot be opened");
  std::stringstream text;
  text << in.rdbuf();
  try {
    YAML::Node node = YAML::Load(text.str());
    if (!node.IsMap()) throw InputError(file, "is not a rig: expected a YAML map at the top");
    return {node, file, ""};
  } catch (const YAML::Exception& e) {
    throw InputError(file + ":" + std::to_string(e.mark.line + 1), "is not valid YAML: " + e.msg);
  }
}

void YamlField::fail(const std::string& what) const {
  throw InputError(file_ + ":" + std::to_string(line()),
                   (path_.empty() ? "" : path_ + ": ") + what + ", got " + shown(node_));
}

void YamlField::only(std::initializer_list<const char*> keys) const {
  if (!node_.IsMap()) fail("expected a map");
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : shown(entry.first);
    const YamlField child(entry.second, file_, joined(path_, key));
    const std::string where = file_ + ":" + std::to_string(entry.first.Mark().line + 1);
    if (!seen.insert(key).second) throw InputError(where, joined(path_, key) + ": given twice");
    if (std::none_of(keys.begin(), keys.end(), [&](const char* k) { return key == k; })) {
      std::string known;
      for (const char* k : keys) known += (known.empty() ? "" : ", ") + std::string(k);
      throw InputError(where, joined(path_, key) + ": unknown key (known here: " + known + ")");
    }
  }
}

std::optional<YamlField> YamlField::find(const std::string& key) const {
  if (!node_.IsMap()) fail("expected a map");
  const YAML::Node child = node_[key];
  if (!child) return std::nullopt;
  return YamlField(child, file_, joined(path_, key));
}

YamlField YamlField::at(const std::string& key) const {
  std::optional<YamlField> child = find(key);
  if (!child) {
    throw InputError(file_ + ":" + std::to_string(line()), joined(path_, key) + ": is missing");
  }
  return *child;
}

std::vector<std::pair<std::string, YamlField>> YamlField::entries() const {
  if (!node_.IsMap()) fail("expected a map of names");
  std::vector<std::pair<std::string, YamlField>> out;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const YamlField child(entry.second, file_, joined(path_, key));
    if (key.empty()) child.fail("expected a name");
    if (!seen.insert(key).second) {
      throw InputError(file_ + ":" + std::to_string(entry.first.Mark().line + 1),
                       joined(path_, key) + ": given twice");
    }
    out.emplace_back(key, child);
  }
  return out;
}

std::vector<YamlField> YamlField::items() const {
  if (!node_.IsSequence()) fail("expected a list");
  std::vector<YamlField> out;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    out.emplace_back(node_[i], file_, path_ + "[" + std::to_string(i) + "]");
  }
  return out;
}

std::string YamlField::text() const {
  if (!node_.IsScalar() || node_.Scalar().empty()) fail("expected text");
  return node_.Scalar();
}

double YamlField::number(double min, double max) const {
  double value = 0.0;
  try {
    if (!node_.IsScalar()) fail("expected a number");
    value = node_.as<double>();
  } catch (const YAML::Exception&) {
    fail("expected a number");
  }
  if (!std::isfinite(value)) fail("expected a finite number");
  if (value < min || value > max) {
    std::ostringstream range;
    const double unbounded = std::numeric_limits<double>::max();
    range << "expected a number ";
    if (min > -unbounded && max < unbounded) {
      range << "from " << min << " to " << max;
    } else if (min > -unbounded) {
      range << "of at least " << min;
    } else {
      range << "of at most " << max;
    }
    fail(range.str());
  }
  return value;
}

double YamlField::positive() const {
  const double value = number();
  if (!(value > 0.0)) fail("expected a positive number");
  return value;
}

double YamlField::number_or(const std::string& key, double otherwise, double min,
                            double max) const {
  const auto field = find(key);
  return field ? field->number(min, max) : otherwise;
}

int YamlField::integer(int min, int max) const {
  const double value = number(min, max);
  if (value != std::floor(value)) fail("expected an integer");
  return static_cast<int>(value);
}

std::vector<double> YamlField::numbers(std::size_t count) const {
  if (!node_.IsSequence() || node_.size() != count) {
    fail("expected a list of " + std::to_string(count) + " numbers");
  }
  std::vector<double> out;
  for (const YamlField& item : items()) out.push_back(item.number());
  return out;
}

Eigen::Vector3d YamlField::vector3() const {
  const std::vector<double> v = numbers(3);
  return {v[0], v[1], v[2]};
}

}  // namespace scattermeter::apps
