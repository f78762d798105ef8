#include "apps/results/material_library.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/input_error.h"
#include "core/material/published_media.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastSigmaA_per_mm = 1e-4;
// Half of the last digit of the published sigma_a, which has four decimals, or two where it is 0.
constexpr double kRounding_per_mm = 5e-5;
constexpr double kRoundingOfZero_per_mm = 5e-3;

double log_ratio(const Quantity& a, const Quantity& b, double least) {
  return std::log(std::max(least, b.value) / std::max(least, a.value));
}

double distance(const std::vector<ChannelComparison>& channels) {
  double sum = 0.0;
  for (const ChannelComparison& c : channels) {
    const double s = log_ratio(c.first.sigma_s_prime_per_mm, c.second.sigma_s_prime_per_mm, 0.0);
    const double a =
        0.5 * log_ratio(c.first.sigma_a_per_mm, c.second.sigma_a_per_mm, kLeastSigmaA_per_mm);
    sum += s * s + a * a;
  }
  return std::sqrt(sum / static_cast<double>(channels.size()));
}

}  // namespace

ReadResult published_library() {
  ReadResult out;
  out.path = "Jensen et al. 2001";
  for (const PublishedMaterial& m : published_materials()) {
    for (std::size_t c = 0; c < 3; ++c) {
      ReadChannel& channel = out.channels.emplace_back();
      channel.material = m.name;
      channel.channel = "RGB"[c];
      channel.eta_int_over_ext = m.eta_int_over_ext;
      const double s = m.sigma_s_prime_per_mm[c], a = m.sigma_a_per_mm[c];
      channel.sigma_s_prime_per_mm = normal_quantity(s, kPublishedStd * s);
      channel.sigma_a_per_mm = normal_quantity(
          a, std::hypot(kPublishedStd * a, a > 0.0 ? kRounding_per_mm : kRoundingOfZero_per_mm));
    }
  }
  return out;
}

ResultFolder results_in(const std::string& folder, const std::string& except) {
  ResultFolder out;
  std::vector<std::string> files;
  std::error_code error;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(folder, options, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code vanished;
    if (it->path().extension() != ".json" || !it->is_regular_file(vanished) ||
        fs::equivalent(it->path(), except, vanished)) {
      continue;
    }
    files.push_back(it->path().string());
  }
  if (error) throw InputError(folder, "cannot be read as a folder of results: " + error.message());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) {
    try {
      out.results.push_back(read_result(file));
    } catch (const InputError&) {
      out.left_out.push_back(file);
    }
  }
  if (out.results.empty()) throw InputError(folder, "holds no result.json to compare with");
  return out;
}

std::vector<LibraryMatch> matches(const ReadResult& result, const std::string& material,
                                  const std::vector<ReadResult>& library) {
  std::vector<LibraryMatch> out;
  for (const ReadResult& known : library) {
    for (const std::string& name : material_names(known)) {
      MaterialComparison comparison =
          compare(result, known, material, name, have_same_rig(result, known));
      if (comparison.channels.empty()) continue;
      const double unlike = distance(comparison.channels);
      out.push_back({known.path, std::move(comparison), unlike});
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const LibraryMatch& a, const LibraryMatch& b) {
    return a.distance < b.distance;
  });
  return out;
}

}  // namespace scattermeter::apps
