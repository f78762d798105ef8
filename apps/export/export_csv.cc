#include <fmt/format.h>

#include "apps/export/export_formats.h"
#include "apps/report/csv.h"

namespace scattermeter::apps {

std::string csv_file(const ReadResult& /*result*/, const std::vector<MeasuredMaterial>& materials,
                     const ExportOptions& /*options*/) {
  std::vector<std::string> header = {"material", "channel", "verdict", "model", "eta"};
  for (const std::string name : {"sigma_s_prime_per_mm", "sigma_a_per_mm"}) {
    for (const char* what : {"", "_std", "_low95", "_high95"}) header.push_back(name + what);
  }
  header.insert(header.end(), {"correlation", "reasons"});
  Csv csv(header);
  for (const MeasuredMaterial& m : materials) {
    for (const ReadChannel& c : m.rgb) {
      std::vector<std::string> row = {c.material, std::string(1, c.channel),
                                      c.refused ? "refused" : "ok", c.model,
                                      csv_number(c.eta_int_over_ext)};
      for (const Quantity& q : {c.sigma_s_prime_per_mm, c.sigma_a_per_mm}) {
        for (double v : {q.value, q.std, q.low95, q.high95}) {
          row.push_back(c.refused ? "" : csv_number(v));
        }
      }
      row.push_back(c.refused ? "" : csv_number(c.correlation));
      row.push_back(fmt::format("{}", fmt::join(c.reasons, " ")));
      csv.add_row(row);
    }
  }
  return csv.text();
}

}  // namespace scattermeter::apps
