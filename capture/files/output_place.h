// Whether results can be written, asked before the work that makes them.
#pragma once

#include <string>

namespace scattermeter::capture {

// Throws InputError naming `folder` unless files can be made in it or, if it is not there, in the
// folder in which it will have to be created. Creates nothing. The disk may still be full.
void require_output_folder(const std::string& folder);

// The same for the folder of a file that is to be written; the file itself must not be a folder.
void require_output_file(const std::string& path);

// Whether both are names of one existing folder.
bool is_same_folder(const std::string& a, const std::string& b);

}  // namespace scattermeter::capture
