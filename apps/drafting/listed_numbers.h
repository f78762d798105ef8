// Numbers in a word of the command line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scattermeter::apps {

// "30x20x10" with the separator 'x'; none for an empty text. Throws InputError naming the option
// and `whole`, the word, for a part that is not a finite number.
std::vector<double> listed_numbers(std::string_view text, char separator, const char* option,
                                   std::string_view whole);

}  // namespace scattermeter::apps
