// Where the search by transport starts.
#pragma once

#include <functional>
#include <span>

#include <Eigen/Core>

#include "core/estimation/channel_result.h"
#include "core/fit/scattering_equation.h"

namespace scattermeter {

// The result by the dipole as that with which a search begins: its estimate is also kept as
// `dipole`.
ChannelResult start_from_dipole(const ChannelResult& by_dipole);

// Moves the start (so far the dipole's estimate) by what transport has found already, `found`
// holding channels that it has searched, among others. Where the dipole does not hold, its
// estimates are off by what the body's shape does to them, and that is nearly the same in like
// media: as transport moved the dipole's estimate of the channel with the most similar one, within
// a factor of e in sigma_s', sigma_s' by their ratio and sigma_a by their difference. Only from
// channels that are not refused; without any, or where the dipole determines nothing (a standard
// deviation beyond half of sigma_s'), the start stays where it is.
void start_like_others(std::span<const ChannelResult> found, Estimate& start);

// Starts where transport ended for the same channel of `found`. False: it was not searched, or the
// search did not find a medium.
bool start_as_before(std::span<const ChannelResult> found, ChannelResult& result);

// Without an estimate: the point whose light is nearest to the shots', of a coarse
// grid of the atlas's nodes and sigma_a / sigma_s from 1e-4 to 4, and between its nodes by a
// parabola. Bodies of size_mm are 5 to 300 mean free paths across. light(node, sigma_a in 1/mm): of
// every part of the shots, at scale 1, relative to the measured one; noise of 10 % is allowed.
// weight: the light of every part, as dark ones hold more noise than light where the medium absorbs
// much. has_free_scale: the light of all parts together tells nothing, and the point has the scale
// that fits it.
ScatteringPoint nearest_point(double size_mm, bool has_free_scale, const Eigen::ArrayXd& weight,
                              const std::function<Eigen::ArrayXd(int, double)>& light);

// From an estimate (the dipole's, or where transport ended); the nearest_point() where it
// determines nothing or misses the image by so much that it is off by factors: full frames of a
// cube of 1.15 per mm, which the dipole misses by 1.2 %, start from 1.6 instead of 0.42.
ScatteringPoint starting_point(const Estimate& dipole, double size_mm, bool has_free_scale,
                               const Eigen::ArrayXd& weight,
                               const std::function<Eigen::ArrayXd(int, double)>& light);

}  // namespace scattermeter
