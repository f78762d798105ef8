#include "apps/results/result_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json quantity(const Quantity& q, bool known) {
  if (!known)
    return {{"value", nullptr},
            {"std", nullptr},
            {"interval95", {nullptr, nullptr}},
            {"upper_limit", false}};
  return {{"value", number(q.value)},
          {"std", number(q.std)},
          {"interval95", {number(q.low95), number(q.high95)}},
          {"upper_limit", is_upper_limit(q)}};
}

Json pulls_json(const Estimate& e) {
  Json list = Json::array();
  for (const PriorPull& p : e.pulls) {
    list.push_back({{"quantity", p.name},
                    {"cause", p.group},
                    {"pull", p.pull},
                    {"offset", p.offset},
                    {"image_relative", p.image_relative},
                    {"least_seen_in_std", number(p.least_seen_in_std)},
                    {"unseen",
                     {{"sigma_s_prime_per_mm", number(p.unseen_sigma_s_prime_per_mm)},
                      {"sigma_a_per_mm", number(p.unseen_sigma_a_per_mm)}}}});
  }
  return list;
}

Json rests_on_json(const Estimate& e) {
  Json list = Json::array();
  for (const PriorPull& p : rests_on(e)) list.push_back(p.group);
  return list;
}

Json budget_json(const Estimate& e) {
  Json list = Json::array();
  for (const BudgetLine& line : e.budget) {
    list.push_back({{"cause", line.cause},
                    {"sigma_s_prime_per_mm", number(line.std_sigma_s_prime_per_mm)},
                    {"sigma_a_per_mm", number(line.std_sigma_a_per_mm)}});
  }
  return list;
}

// Number of excluded patches by reason, summed over the shots.
Json left_out_json(const ChannelResult& r) {
  const auto count = [&](RowState s) { return r.patches_by_state[static_cast<std::size_t>(s)]; };
  return {{"silhouette_or_crease", r.patches_partly_seen},
          {"no_sample_of_this_colour", count(RowState::kNoSamples)},
          {"clipped", count(RowState::kClipped)},
          {"cut_at_zero", count(RowState::kFloor)},
          {"mirrors_a_light", count(RowState::kMirror)},
          {"deep_in_noise", count(RowState::kNoise)},
          {"outlier", count(RowState::kOutlier)},
          {"at_an_edge", count(RowState::kEdge)}};
}

// An estimate besides the reported one.
Json short_estimate(const Estimate& e) {
  return {{"sigma_s_prime_per_mm", quantity(e.sigma_s_prime_per_mm, e.converged)},
          {"sigma_a_per_mm", quantity(e.sigma_a_per_mm, e.converged)},
          {"verdict", e.reasons.empty() ? "ok" : "refused"},
          {"reasons", e.reasons}};
}

// The estimates from each shot alone, and whether they agree.
Json singles_json(const ChannelResult& r) {
  Json j;
  j["chi2"] = number(r.agreement.chi2);
  j["degrees_of_freedom"] = r.agreement.dof;
  j["p_value"] = number(r.agreement.p_value);
  j["shots"] = Json::array();
  for (const ShotResult& s : r.singles) {
    Json shot = {{"shot", s.file}};
    shot.update(short_estimate(s.estimate));
    j["shots"].push_back(shot);
  }
  return j;
}

// r(d) recovered without the dipole, at the distances determined by the image.
Json reflectance_json(const ChannelResult& r) {
  Json j;
  j["reasons"] = r.recovered->reasons;
  j["dipole_p_value"] = r.misfit ? number(r.misfit->p_value) : Json(nullptr);
  j["departure_from_dipole_log"] = r.misfit ? number(r.misfit->log_departure) : Json(nullptr);
  j["knots"] = Json::array();
  for (const ReflectanceKnot& k : r.recovered->knots) {
    j["knots"].push_back(
        {{"distance_mm", number(k.distance_mm)},
         {"r_per_mm2", number(k.r_per_mm2)},
         {"interval95_per_mm2", {number(k.low95_per_mm2), number(k.high95_per_mm2)}},
         {"resolution_mm", number(k.spread_mm)},
         {"determined", k.determined}});
  }
  return j;
}

Json by_channel(const std::array<std::size_t, kRgb>& counts) {
  Json j;
  for (std::size_t c = 0; c < kRgb; ++c) j[std::string(1, kRgbName[c])] = counts[c];
  return j;
}

Json brackets_json(const Measurement& m) {
  Json list = Json::array();
  for (const MergedBracket& b : m.brackets) {
    Json files = Json::array();
    for (const MergedBracket::File& f : b.files) {
      files.push_back({{"file", f.file},
                       {"exposure_s", number(f.exposure_s)},
                       {"samples", by_channel(f.samples)},
                       {"log_light_over_others", number(f.departure.log_ratio)},
                       {"log_light_over_others_std", number(f.departure.noise_std)}});
    }
    list.push_back({{"shot", b.shot},
                    {"files", files},
                    {"samples", by_channel(b.samples)},
                    {"samples_clipped_in_all", by_channel(b.samples_clipped)}});
  }
  return list;
}

Json channel_json(const ChannelResult& r) {
  const Estimate& e = r.estimate;
  const bool known = e.converged;
  Json j;
  j["material"] = r.material;
  j["channel"] = std::string(1, r.channel);
  j["model"] = r.model;
  j["eta"] = r.eta_int_over_ext;
  j["sigma_s_prime_per_mm"] = quantity(e.sigma_s_prime_per_mm, known);
  j["sigma_a_per_mm"] = quantity(e.sigma_a_per_mm, known);
  j["correlation"] = known ? number(e.correlation) : Json(nullptr);
  j["scale"] = quantity(e.scale, known);
  j["budget"] = budget_json(e);
  j["pulls"] = pulls_json(e);
  j["rests_on"] = rests_on_json(e);
  j["verdict"] = r.refused() ? "refused" : "ok";
  j["reasons"] = e.reasons;
  j["residual"] = {{"rms_relative", known ? number(e.rms_relative) : Json(nullptr)},
                   {"reduced_chi2", known ? number(e.reduced_chi2) : Json(nullptr)},
                   {"psnr_db", known ? number(e.psnr_db) : Json(nullptr)},
                   {"misfit_relative", known ? number(e.misfit_relative) : Json(nullptr)},
                   {"misfit_p_value", known ? number(e.misfit_p_value) : Json(nullptr)}};
  j["patches"] = e.rows;
  j["patches_left_out"] = left_out_json(r);
  j["shots"] = r.shots;
  if (!r.singles.empty()) j["agreement"] = singles_json(r);
  if (r.dipole) {
    const std::optional<DipoleDistance> far = dipole_distance(r);
    if (!r.why_transport.empty()) j["why_transport"] = r.why_transport;
    Json& dipole = j["dipole"] = short_estimate(*r.dipole);
    dipole["sigma_s_prime_off_relative"] =
        far ? number(far->sigma_s_prime_relative) : Json(nullptr);
    dipole["sigma_a_off_per_mm"] = far ? number(far->sigma_a_per_mm) : Json(nullptr);
  }
  if (r.recovered && r.model == "dipole") j["reflectance"] = reflectance_json(r);
  return j;
}

}  // namespace

std::string result_json(const Measurement& m, const std::string& command_line) {
  Json j;
  j["$schema"] = kResultSchema;
  j["results"] = Json::array();
  for (const ChannelResult& r : m.results) j["results"].push_back(channel_json(r));
  j["patch_size_mm"] = Json::object();
  for (const auto& [object, size] : m.patch_size_mm) j["patch_size_mm"][object] = size;
  if (!m.brackets.empty()) j["brackets"] = brackets_json(m);
  j["skipped"] = {{"shots_not_asked_for", m.skipped.shots_not_asked},
                  {"channels_not_asked_for", m.skipped.channels_not_asked},
                  {"shots_decoded_before", m.skipped.shots_from_cache},
                  {"samples_beside_the_objects", m.skipped.samples_outside},
                  {"patches_not_seen", m.skipped.patches_unseen},
                  {"patches_not_lit", m.skipped.patches_unlit},
                  {"shadow_rays_on_convex_objects", m.skipped.shadow_rays},
                  {"patches_beyond_precision", m.skipped.rows},
                  {"negligible_nuisances", m.skipped.nuisances}};
  j["notes"] = m.notes;
  j["timing_s"] = Json::object();
  for (const auto& [stage, seconds] : m.timing_s) j["timing_s"][stage] = seconds;
  j["version"] = kVersion;
  j["command"] = command_line;
  j["inputs"] = Json::array();
  for (const InputFile& f : m.inputs)
    j["inputs"].push_back({{"file", f.path}, {"sha256", f.sha256}});
  // File names may contain bytes that are not valid UTF-8; they are replaced.
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace scattermeter::apps
