#include "apps/checking/transport_departures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "core/base/dense_solve.h"

namespace scattermeter::apps {
namespace {

constexpr double kLeastTold = 1e-9;

// The standard deviations of the LEDs' positions as the rig states them, by the nuisances' names.
std::map<std::string, double> stated_std_mm(const Scene& stated) {
  std::map<std::string, double> out;
  for (const SceneLight& light : stated.lights) {
    const LedLight* led = light.led();
    if (led == nullptr) continue;
    for (int axis = 0; axis < 3; ++axis) {
      out[light.name + ".position" + std::to_string(axis)] =
          led->calibrated ? std::sqrt(led->calibrated->covariance(axis, axis))
                          : led->position_std_mm;
    }
  }
  return out;
}

}  // namespace

void take_evidence(const Scene& stated, const ChannelResult& result,
                   const std::vector<Nuisance>& nuisances,
                   const std::vector<const ObservedShot*>& shots, ShotDepartures& departures) {
  const RigEvidence& evidence = result.evidence;
  const auto n = static_cast<Eigen::Index>(evidence.nuisances.size());
  const std::map<std::string, double> stated_std = stated_std_mm(stated);
  Eigen::VectorXd tighter = Eigen::VectorXd::Ones(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Nuisance& of = evidence.nuisances[static_cast<std::size_t>(i)];
    const auto known = stated_std.find(of.name);
    if (known != stated_std.end() && of.std > 0.0) tighter[i] = known->second / of.std;
  }
  const Eigen::MatrixXd covariance =
      SymmetricSolver(Eigen::MatrixXd::Identity(n, n) +
                      tighter.asDiagonal() * evidence.information * tighter.asDiagonal())
          .inverse();
  const Eigen::VectorXd value = covariance * tighter.cwiseProduct(evidence.score);
  const auto of_name = [&](const std::string& name) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const Nuisance& of = evidence.nuisances[static_cast<std::size_t>(i)];
      if (of.name != name) continue;
      const double std = tighter[i] * of.std;
      const double told = 1.0 - covariance(i, i);  // by the image, of the prior's variance
      if (!(told > kLeastTold)) break;
      return Departure{std * value[i] / told, std / std::sqrt(told)};
    }
    return Departure{0.0, std::numeric_limits<double>::infinity()};
  };
  for (std::size_t k = 0; k < nuisances.size(); ++k) {
    departures.nuisances[k] = of_name(nuisances[k].name);
  }
  for (std::size_t s = 0; s < shots.size(); ++s) {
    departures.even_relative[s] = of_name("even light " + shots[s]->stated->file);
    if (!result.agreement.disagree()) {
      departures.power_relative[s] = {0.0, std::numeric_limits<double>::infinity()};
    }
  }
}

}  // namespace scattermeter::apps
