// Whether two results are of the same material.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/results/result_reader.h"

namespace scattermeter::apps {

struct Difference {
  double value = 0;  // second minus first, 1/mm
  double std = 0;    // causes that both share are counted once
};

struct ChannelComparison {
  ReadChannel first, second;
  Difference sigma_s_prime_per_mm, sigma_a_per_mm;
  // Of a difference of both at least as improbable, if there is none.
  double p_value = 1;
};

// The verdict below which two materials are told to be different: so many pairs of equal ones are.
inline constexpr double kDifferentPValue = 0.01;

struct MaterialComparison {
  std::string first, second;                // materials
  std::vector<ChannelComparison> channels;  // measured in both; may be empty
  // Of the most improbable channel, times their number: channels of one measurement share errors.
  double p_value = 1;
  bool is_different() const { return p_value < kDifferentPValue; }
};

// share_rig: both were measured with one rig, so that its scale, lens, pose, LEDs and surroundings
// were off by the same in both, and shifted each by its own response (ReadChannel::responses). Eta,
// size, position and edges are each piece's own. Results without responses, and such as would then
// differ by less than their noise, share nothing.
ChannelComparison compare(const ReadChannel& first, const ReadChannel& second, bool share_rig);

// Pairs of materials: those of `named` ("PP" or "PP=PE", the second from the second file), or else
// all that both files hold, or else, where each holds one only, these. Throws InputError if a name
// is not there and if nothing can be compared.
std::vector<std::pair<std::string, std::string>> pairs_of(const ReadResult& first,
                                                          const ReadResult& second,
                                                          const std::vector<std::string>& named);

// Whether both results state the same rig file, by its digest.
bool have_same_rig(const ReadResult& first, const ReadResult& second);

// A material of each. Its channels are empty where none is measured in both.
MaterialComparison compare(const ReadResult& first, const ReadResult& second,
                           const std::string& ours, const std::string& theirs, bool share_rig);

// The same for pairs of materials. Throws InputError where no channel is measured in both files.
std::vector<MaterialComparison> compare(
    const ReadResult& first, const ReadResult& second,
    const std::vector<std::pair<std::string, std::string>>& pairs, bool share_rig);

}  // namespace scattermeter::apps
