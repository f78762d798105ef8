#include "core/base/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace scattermeter {
namespace {

char small_letter(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

constexpr std::size_t kFewestLettersOfABeginning = 3;

bool begins(std::string_view whole, std::string_view part) {
  return part.size() >= kFewestLettersOfABeginning && whole.size() > part.size() &&
         edit_distance(whole.substr(0, part.size()), part) == 0;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Rows i - 2, i - 1 and i of the table of distances between the beginnings of both words.
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k) row[k] = k;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i;
    const char x = small_letter(a[i - 1]);
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const char y = small_letter(b[k - 1]);
      row[k] = std::min({above[k] + 1, row[k - 1] + 1, above[k - 1] + (x == y ? 0U : 1U)});
      if (i > 1 && k > 1 && x == small_letter(b[k - 2]) && small_letter(a[i - 2]) == y) {
        row[k] = std::min(row[k], before[k - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& names) {
  std::optional<std::string> best;
  std::size_t least = 0;
  for (const std::string& name : names) {
    const bool beginning = begins(name, word) || begins(word, name);
    const std::size_t distance = beginning ? 1 : edit_distance(word, name);
    const std::size_t most = std::max<std::size_t>(1, std::max(word.size(), name.size()) / 3);
    // Nothing is left of a word of which every letter is replaced.
    if (distance > most || distance >= std::max(word.size(), name.size())) continue;
    if (!best || distance < least) {
      best = name;
      least = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  const std::optional<std::string> name = nearest_name(word, names);
  return name ? "; did you mean " + *name + "?" : "";
}

}  // namespace scattermeter
