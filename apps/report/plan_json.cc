#include "apps/report/plan_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "apps/planning/plan_assumptions.h"
#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::ordered_json;

Json finite_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json position_json(const Eigen::Vector3d& at) { return {at.x(), at.y(), at.z()}; }

Json forecast_json(const Forecast& f) {
  const Estimate& e = f.estimate;
  const auto quantity = [&](double expected, const Quantity& q) -> Json {
    return {{"expected", expected},
            {"std", e.converged ? finite_json(q.std) : Json(nullptr)},
            {"interval95", e.converged ? Json{finite_json(q.low95), finite_json(q.high95)}
                                       : Json{nullptr, nullptr}}};
  };
  Json j;
  j["sigma_s_prime_per_mm"] = quantity(f.medium.sigma_s_prime_per_mm, e.sigma_s_prime_per_mm);
  j["sigma_a_per_mm"] = quantity(f.medium.sigma_a_per_mm, e.sigma_a_per_mm);
  j["correlation"] = e.converged ? finite_json(e.correlation) : Json(nullptr);
  j["budget"] = Json::array();
  for (const BudgetLine& line : e.budget) {
    j["budget"].push_back({{"cause", line.cause},
                           {"sigma_s_prime_per_mm", finite_json(line.std_sigma_s_prime_per_mm)},
                           {"sigma_a_per_mm", finite_json(line.std_sigma_a_per_mm)}});
  }
  j["verdict"] = e.reasons.empty() ? "ok" : "refused";
  j["reasons"] = e.reasons;
  return j;
}

Json planned_channel_json(const PlannedChannel& c) {
  Json j;
  j["material"] = c.result.material;
  j["channel"] = std::string(1, c.result.channel);
  j["eta"] = c.result.eta_int_over_ext;
  j.update(forecast_json(c.expected));
  j["patches"] = c.result.estimate.rows;
  j["shots"] = c.result.shots;
  j["known_exactly"] = Json::array();
  for (const KnownCause& k : known_causes(c.result.estimate)) {
    j["known_exactly"].push_back(
        {{"cause", k.cause},
         {"sigma_s_prime_std_per_mm", finite_json(k.sigma_s_prime_std_per_mm)},
         {"sigma_a_std_per_mm", finite_json(k.sigma_a_std_per_mm)}});
  }
  if (!c.corners.empty()) {
    j["corners"] = Json::array();
    for (const Forecast& corner : c.corners) j["corners"].push_back(forecast_json(corner));
  }
  return j;
}

Json exposure_json(const ExposureAdvice& a) {
  return {{"shot", a.shot},
          {"channel", std::string(1, a.channel)},
          {"exposure_s", a.exposure_s},
          {"chosen", a.chosen},
          {"brightest_counts", finite_json(a.brightest_counts)},
          {"dark_tenth_counts", finite_json(a.dark_counts)},
          {"range_counts", finite_json(a.range_counts)},
          {"clipped_share", finite_json(a.clipped_share)},
          {"dark_share", finite_json(a.dark_share)},
          {"suggested_exposure_s", a.suggested_s},
          {"advice", a.advice}};
}

Json suggestion_json(const SuggestedShots& o) {
  Json j;
  j["material"] = o.material;
  j["channel"] = std::string(1, o.channel);
  j["sigma_a_relative_std"] = finite_json(o.planned);
  j["coarse_over_fine"] = finite_json(o.coarse_ratio);
  j["gains"] = Json::array();
  for (const Gain& g : o.gains) {
    j["gains"].push_back({{"with", g.what},
                          {"sigma_s_prime_std_ratio", finite_json(g.sigma_s_prime_ratio)},
                          {"sigma_a_std_ratio", finite_json(g.sigma_a_ratio)}});
  }
  j["led_maps"] = Json::array();
  for (const LedMap& m : o.maps) {
    Json positions = Json::array();
    for (const LedPosition& p : m.positions) {
      positions.push_back({{"position_mm", position_json(p.position_mm)},
                           {"one_shot_sigma_a_relative_std", finite_json(p.alone)},
                           {"one_more_shot_sigma_a_relative_std", finite_json(p.joined)}});
    }
    j["led_maps"].push_back({{"object", m.object},
                             {"led_like", m.like},
                             {"center_mm", position_json(m.center_mm)},
                             {"distance_mm", m.distance_mm},
                             {"places", positions}});
  }
  return j;
}

}  // namespace

std::string plan_json(const Plan& plan, const std::string& command_line) {
  Json j;
  j["forecast"] = Json::array();
  for (const PlannedChannel& c : plan.channels) j["forecast"].push_back(planned_channel_json(c));
  j["assumes"] = {{"model", "dipole"},
                  {"materials", plan.from_truth ? "truth.materials" : "given range"},
                  {"noise", plan.calibrated_noise ? "camera.radiance" : "camera.sensor"}};
  Json& noise = j["assumes"]["noise_model"];
  for (std::size_t c = 0; c < kRgb; ++c) {
    noise[std::string(1, kRgbName[c])] = {{"gain_e_per_count", plan.noise[c].gain_e_per_count},
                                          {"read_noise_counts", plan.noise[c].read_noise_counts}};
  }
  j["assumes"]["in_words"] = plan_assumptions(plan);
  j["exposures"] = Json::array();
  for (const ExposureAdvice& a : plan.exposures) j["exposures"].push_back(exposure_json(a));
  j["other_shots"] = Json::array();
  for (const SuggestedShots& o : plan.suggested_shots)
    j["other_shots"].push_back(suggestion_json(o));
  j["patch_size_mm"] = Json::object();
  for (const auto& [object, size] : plan.patch_size_mm) j["patch_size_mm"][object] = size;
  j["timing_s"] = Json::object();
  for (const auto& [stage, seconds] : plan.timing_s) {
    j["timing_s"][stage] = j["timing_s"].value(stage, 0.0) + seconds;
  }
  j["version"] = kVersion;
  j["command"] = command_line;
  j["inputs"] = Json::array();
  for (const InputFile& f : plan.inputs) {
    j["inputs"].push_back({{"file", f.path}, {"sha256", f.sha256}});
  }
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace scattermeter::apps
