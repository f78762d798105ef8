#include "apps/csv.h"
#include "apps/export_formats.h"

namespace scattermeter::apps {

std::string csv_file(const std::vector<MeasuredMaterial>& materials) {
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
      std::string reasons;
      for (const std::string& r : c.reasons) reasons += (reasons.empty() ? "" : " ") + r;
      row.push_back(reasons);
      csv.add_row(row);
    }
  }
  return csv.text();
}

}  // namespace scattermeter::apps
