// Whether a file says a word anywhere.
#pragma once

#include <string>
#include <string_view>

namespace scattermeter::capture {

// word: 4 to 100 small letters a to z; the file may have it in capitals, too, and its letters next
// to each other or, as in UTF-16, in every other byte. Throws InputError naming the file when it
// cannot be read.
bool says_word(const std::string& path, std::string_view word);

}  // namespace scattermeter::capture
