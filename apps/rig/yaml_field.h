// Strict reading of YAML by name and kind, with errors that name file, line and field.
#pragma once

#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

namespace scattermeter::apps {

// A node with its file, line and dotted path. All failures are InputError
// "file:line: camera.fx_px: expected ..., got ...".
class YamlField {
 public:
  YamlField(const YAML::Node& node, std::string file, std::string path);

  // The whole file. Throws InputError if it cannot be read or is not YAML.
  static YamlField load(const std::string& file);

  int line() const { return node_.Mark().line + 1; }
  const std::string& path() const { return path_; }
  bool is_map() const { return node_.IsMap(); }
  bool is_scalar() const { return node_.IsScalar(); }

  // Requires a map without repeated keys and without other keys than these.
  void only(std::initializer_list<const char*> keys) const;
  YamlField at(const std::string& key) const;
  std::optional<YamlField> find(const std::string& key) const;
  // Children of a map in the order of the file; requires names that are unique and not empty.
  std::vector<std::pair<std::string, YamlField>> entries() const;
  std::vector<YamlField> items() const;

  std::string text() const;  // not empty
  // A finite number in [min, max].
  double number(double min = -std::numeric_limits<double>::max(),
                double max = std::numeric_limits<double>::max()) const;
  double positive() const;
  // Of a key of a map, which may be absent.
  double number_or(const std::string& key, double otherwise, double min, double max) const;
  int integer(int min, int max) const;
  bool boolean() const;
  std::vector<double> numbers(std::size_t count) const;
  Eigen::Vector3d vector3() const;

  // Appends "got <value>", then the advice.
  [[noreturn]] void fail(const std::string& what, const std::string& advice = {}) const;

 private:
  YAML::Node node_;
  std::string file_;
  std::string path_;
};

}  // namespace scattermeter::apps
