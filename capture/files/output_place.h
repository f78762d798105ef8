// Whether results can be written, asked before the work that makes them.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::capture {

// Throws InputError naming `folder` unless files can be made in it or, if it is not there, in the
// folder in which it will have to be created. Creates nothing. The disk may still be full.
void require_output_folder(const std::string& folder);

// The same for the folder of a file that is to be written. It replaces an existing one, which must
// be no folder and none of the inputs (files, or folders of which none but YAML is replaced).
void require_output_file(const std::string& path, const std::vector<std::string>& inputs = {});

// Whether both are names of one existing folder.
bool is_same_folder(const std::string& a, const std::string& b);

}  // namespace scattermeter::capture
