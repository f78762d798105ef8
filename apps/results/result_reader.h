// Reading of result.json.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/fit/estimate.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

// How an estimate follows an error of the rig.
struct RigResponse {
  std::string quantity;  // of the rig, such as led1.position0
  std::string cause;
  // Of (sigma_s', sigma_a), 1/mm, to an error of the quantity by its stated standard deviation.
  Eigen::Vector2d shift_per_mm = Eigen::Vector2d::Zero();
};

// One entry of `results`. Numbers that the file does not contain are NaN.
struct ReadChannel {
  std::string material;
  char channel = 'R';  // R, G, B
  std::string model;   // of the estimate
  double eta_int_over_ext = 1;
  Quantity sigma_s_prime_per_mm;  // unless refused: value > 0
  Quantity sigma_a_per_mm;        // unless refused: value >= 0
  double correlation = 0;
  std::vector<BudgetLine> budget;      // empty: not in the file
  std::vector<RigResponse> responses;  // the same; only to what is stated as uncertain
  bool refused = false;
  std::vector<std::string> reasons;

  Medium medium() const {
    return {sigma_s_prime_per_mm.value, sigma_a_per_mm.value, eta_int_over_ext};
  }
};

struct ReadResult {
  std::string path;
  std::string version;  // of the program that measured
  std::string command;
  std::string rig_sha256;             // of the first input; empty: not in the file
  std::vector<ReadChannel> channels;  // in the file's order
};

// Throws InputError naming file, field and value for a file that cannot be read, is not JSON or not
// a result: a field is missing or of another kind, a channel is given twice, a number is out of its
// domain. Ignores all other fields.
ReadResult read_result(const std::string& path);

// In the order of their first channels.
std::vector<std::string> material_names(const ReadResult& result);
// Throws InputError naming the file unless it holds the material.
void require_material(const ReadResult& result, const std::string& name);

// The three channels of a material.
struct MeasuredMaterial {
  std::string name;
  double eta_int_over_ext = 1;
  std::array<ReadChannel, 3> rgb;
  bool refused() const { return rgb[0].refused || rgb[1].refused || rgb[2].refused; }
};

// The materials in the order of their first channel, only those of `names` unless it is empty.
// Throws InputError for a name that is not in the result, for a material without one of R, G, B and
// for channels with different eta.
std::vector<MeasuredMaterial> materials_of(const ReadResult& result,
                                           const std::vector<std::string>& names = {});

std::vector<std::string> names_of(const std::vector<MeasuredMaterial>& materials);

// One line for each refused channel with the reason.
std::vector<std::string> refusals(const std::vector<MeasuredMaterial>& materials);

}  // namespace scattermeter::apps
