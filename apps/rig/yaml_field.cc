#include "apps/rig/yaml_field.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "capture/files/file_text.h"
#include "core/base/input_error.h"
#include "core/base/nearest_name.h"
#include "core/base/utf8.h"

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

// What ", got 1,4" is to be told: a comma where YAML has a point.
const char* const kDecimalComma = "; write decimals with a point, not with a comma";

bool is_digits(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

// As text editors insert them: a no-break space (U+00A0), and a minus sign (U+2212).
const char* const kOddSpace = "; it contains a no-break space, write an ordinary one";
bool has_odd_space(const std::string& text) { return text.find("\u00a0") != std::string::npos; }

// "1,4", "-0,05", "1,4e-3".
bool has_decimal_comma(const std::string& text) {
  static const std::regex pattern("[-+]?[0-9]+,[0-9]+([eE][-+]?[0-9]+)?");
  return std::regex_match(text, pattern);
}

// What is to be told of a text that should be a number; "" if nothing is known.
const char* number_advice(const std::string& text) {
  if (has_decimal_comma(text)) return kDecimalComma;
  if (has_odd_space(text)) return kOddSpace;
  return text.find("\u2212") != std::string::npos ? "; write the minus sign as a hyphen" : "";
}

// The number of the first line that is indented by a tab, up to `last`; 0: none.
int line_with_tab(const std::string& text, int last) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; number <= last && std::getline(lines, line); ++number) {
    const std::size_t tab = line.find('\t');
    if (tab != std::string::npos && tab < line.find_first_not_of(" \t")) return number;
  }
  return 0;
}

}  // namespace

YamlField::YamlField(const YAML::Node& node, std::string file, std::string path)
    : node_(node), file_(std::move(file)), path_(std::move(path)) {}

YamlField YamlField::load(const std::string& file) {
  const std::string text = capture::file_text(file, "a rig file is expected");
  if (text.find('\0') != std::string::npos) {
    throw InputError(file, "is not a text file; a rig is a YAML file, as `init` begins one");
  }
  if (const std::size_t at = first_no_utf8(text); at < text.size()) {
    const auto line = 1 + std::count(text.data(), text.data() + at, '\n');
    throw InputError(file + ":" + std::to_string(line),
                     "has a letter that is not encoded in UTF-8; save the file as UTF-8");
  }
  try {
    YAML::Node node = YAML::Load(text);
    if (!node.IsMap()) throw InputError(file, "is not a rig: expected a YAML map at the top");
    return {node, file, ""};
  } catch (const YAML::Exception& e) {
    const int line = e.mark.line + 1;
    // The parser notices a wrong indentation only in the line after it.
    if (const int tab = line_with_tab(text, line + 1); tab > 0) {
      throw InputError(file + ":" + std::to_string(tab),
                       "the line is indented by a tab, which YAML does not allow; use spaces");
    }
    // The parser reads on from a bracket that is not closed, and stops somewhere below.
    const bool open = e.msg.starts_with("end of ");
    throw InputError(file + ":" + std::to_string(line),
                     "is not valid YAML: " + e.msg +
                         (open ? "; is a bracket or quote on this line or above left open?" : ""));
  }
}

void YamlField::fail(const std::string& what, const std::string& advice) const {
  throw InputError(file_ + ":" + std::to_string(line()),
                   (path_.empty() ? "" : path_ + ": ") + what + ", got " + shown(node_) + advice);
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
      const std::vector<std::string> names(keys.begin(), keys.end());
      std::string known;
      for (const std::string& k : names) known += (known.empty() ? "" : ", ") + k;
      // {eta: 1,4} is a map with the keys eta and 4.
      throw InputError(where, joined(path_, key) + ": unknown key" +
                                  (is_digits(key)       ? kDecimalComma
                                   : has_odd_space(key) ? kOddSpace
                                                        : did_you_mean(key, names)) +
                                  " (known here: " + known + ")");
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
    fail(std::string("expected a number") +
         (node_.IsScalar() ? number_advice(node_.Scalar()) : ""));
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

bool YamlField::boolean() const {
  const std::string value = text();
  if (value != "true" && value != "false") fail("expected true or false");
  return value == "true";
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
    // [1,5, 2, 3] has four numbers.
    const bool commas = node_.IsSequence() && node_.size() > count && node_.size() <= 2 * count;
    fail("expected a list of " + std::to_string(count) + " numbers" +
         (commas ? kDecimalComma : ""));
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
