// Camera makes whose files must not reach LibRaw.
#pragma once

#include <string>

namespace scattermeter::capture {

// Throws InputError naming the file when the word "Hasselblad" occurs anywhere in it, in letters of
// either case and of one or two bytes, or when the file cannot be opened. LibRaw 0.20 joins the
// names found in files of this make in buffers of 64 bytes without checking their length
// (LibRaw::parseHassyModel), and takes the make from many containers and fields: only the absence
// of the word rules the overflow out.
void refuse_unsafe_make(const std::string& path);

}  // namespace scattermeter::capture
