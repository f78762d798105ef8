// Known materials like a measured one, as a table for the terminal.
#pragma once

#include <string>
#include <vector>

#include "apps/results/material_library.h"

namespace scattermeter::apps {

// The `most` likest, one line each: differences of sigma_s' and sigma_a by channel, whether they
// are beyond the errors, then a sentence about the likest. matches: of the material `name`, in
// order.
std::string library_table(const std::string& name, const std::vector<LibraryMatch>& matches,
                          std::size_t most = 5);

}  // namespace scattermeter::apps
