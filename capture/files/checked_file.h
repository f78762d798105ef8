// Files with a digest of their content: what is damaged or cut off is not there.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace scattermeter::capture {

// The content; empty where there is no such file, or its digest is wrong.
std::optional<std::string> read_checked_file(const std::string& path);

// In one step (pending_file.h); missing folders are created. Throws InputError naming the file or
// folder.
void write_checked_file(const std::string& path, std::string_view content);

}  // namespace scattermeter::capture
