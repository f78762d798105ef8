// Suggestions for mistyped names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scattermeter {

// The fewest insertions, deletions and replacements of single letters and swaps of two neighbours
// that make `b` of `a`, no letter being changed twice (optimal string alignment); capital letters
// equal small ones.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The name that the word was probably meant to be: the one at the least edit_distance(), the first
// of several, if that is at most a third of the letters of the longer one and at least one edit is
// allowed. A name that begins with the word (three letters or more), or the other way round, as
// with a forgotten unit, counts as one edit away. nullopt if there is none.
std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& names);

// "; did you mean NAME?", or "" if no name is near. To be appended to a message.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace scattermeter
