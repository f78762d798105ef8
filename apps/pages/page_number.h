// Numbers as they stand in the data of a page.
#pragma once

namespace scattermeter::apps {

// The value with six significant digits: shorter to write, and finer than a page shows; 0 has no
// sign.
double page_number(double value);

}  // namespace scattermeter::apps
