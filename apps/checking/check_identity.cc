#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "apps/checking/check.h"

namespace scattermeter::apps {
namespace {

// Whether the lights that the rig lists for a shot explain its image better than others.
CheckItem lights_of_shots(const CheckedRig& checked) {
  std::vector<CheckDetail> details;
  std::vector<std::string> others;
  for (std::size_t i = 0; i < checked.fit.likeness.size(); ++i) {
    const ShotLikeness& like = checked.fit.likeness[i];
    if (!std::isfinite(like.own)) continue;
    // Better matches count only if its own lights explain the image badly; otherwise many do.
    const bool doubtful = 100.0 * like.own > checked.options.max_residual_percent;
    const double ratio = std::isfinite(like.best_other) ? like.own / like.best_other : 0.0;
    details.push_back(checked.of_shot(i, doubtful ? ratio : std::min(ratio, 1.0)));
    others.push_back(like.other);
  }
  CheckItem item = judged("light in shot", "x the misfit of others", {1.0},
                          "check whether files are exchanged or shots.lights is wrong", details);
  for (std::size_t k = 0; k < item.details.size() && !item.passed; ++k) {
    if (item.details[k].where == item.where) {
      item.where += " looks " + others[k];
      break;
    }
  }
  return item;
}

struct Single {
  std::size_t shot = 0;
  std::size_t material = 0;
  std::array<double, kRgb> log_s{};  // NaN: no estimate
};

// The shots with an estimate from that shot alone in at least one channel.
std::vector<Single> singles_of(const CheckedRig& checked) {
  std::map<std::size_t, Single> by_shot;
  const std::vector<std::string> materials = checked.rig.scene.materials();
  for (const CheckedChannel& fitted : checked.fit.channels) {
    for (std::size_t k = 0; k < fitted.singles.size(); ++k) {
      const auto [it, is_new] = by_shot.try_emplace(fitted.shots[k]);
      Single& s = it->second;
      if (is_new) {
        s.log_s.fill(std::numeric_limits<double>::quiet_NaN());
        s.shot = fitted.shots[k];
        while (materials[s.material] != fitted.material) ++s.material;
      }
      const Estimate& e = fitted.singles[k].estimate;
      if (e.converged && e.sigma_s_prime_per_mm.value > 0.0) {
        s.log_s[fitted.channel] = std::log(e.sigma_s_prime_per_mm.value);
      }
    }
  }
  std::vector<Single> out;
  for (const auto& [shot, single] : by_shot) out.push_back(single);
  return out;
}

// Sum of the squared deviations of all estimates from their material's mean, and their number.
struct Spread {
  double squares = 0;
  double n = 0;
  double rms() const { return n > 0.0 ? std::sqrt(squares / n) : 0.0; }
};
Spread spread_of(const std::vector<Single>& singles) {
  Spread out;
  struct Mean {
    double n = 0, sum = 0, squares = 0;
  };
  std::map<std::pair<std::size_t, std::size_t>, Mean> means;
  for (const Single& s : singles) {
    for (std::size_t c = 0; c < kRgb; ++c) {
      if (!std::isfinite(s.log_s[c])) continue;
      Mean& m = means[{s.material, c}];
      m.n += 1.0;
      m.sum += s.log_s[c];
      m.squares += s.log_s[c] * s.log_s[c];
    }
  }
  for (const auto& [key, m] : means) {
    out.squares += std::max(0.0, m.squares - m.sum * m.sum / m.n);
    out.n += m.n;
  }
  return out;
}

// Whether two shots of one object under the same lights were exchanged. They share the error that
// the dipole makes on the object, so it is not mistaken for an exchange.
CheckItem materials_of_shots(const CheckedRig& checked) {
  std::vector<Single> singles = singles_of(checked);
  const Spread listed = spread_of(singles);
  struct Swap {
    std::size_t a = 0, b = 0;
    double rms = 0;
  };
  std::optional<Swap> best;
  for (std::size_t a = 0; a < singles.size(); ++a) {
    for (std::size_t b = a + 1; b < singles.size(); ++b) {
      const SceneShot& of_a = *checked.shots[singles[a].shot].stated;
      const SceneShot& of_b = *checked.shots[singles[b].shot].stated;
      if (of_a.object != of_b.object || of_a.lights != of_b.lights ||
          of_a.material == of_b.material) {
        continue;
      }
      std::swap(singles[a].material, singles[b].material);
      const double rms = spread_of(singles).rms();
      std::swap(singles[a].material, singles[b].material);
      if (!best || rms < best->rms) best = Swap{a, b, rms};
    }
  }
  std::vector<CheckDetail> details;
  std::string where;
  if (best) {
    // An exchange is reported only if it removes a third of the spread.
    constexpr double kRemaining = 2.0 / 3.0;
    const double gained = 100.0 * (listed.rms() - best->rms);
    const bool clear = best->rms < kRemaining * listed.rms();
    for (const std::size_t k : {best->a, best->b}) {
      details.push_back(checked.of_shot(singles[k].shot, clear ? std::max(0.0, gained) : 0.0));
    }
    where = checked.shots[singles[best->a].shot].stated->file + " and " +
            checked.shots[singles[best->b].shot].stated->file;
  }
  CheckItem item = judged("material in shot", "% spread of sigma_s'",
                          {checked.options.max_material_spread_percent},
                          "check whether these two files are exchanged", details);
  if (!item.passed) item.where = where;
  return item;
}

}  // namespace

std::vector<CheckItem> check_identity(const CheckedRig& checked) {
  return {lights_of_shots(checked), materials_of_shots(checked)};
}

}  // namespace scattermeter::apps
