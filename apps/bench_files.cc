#include "apps/bench_commands.h"
#include "apps/result_json.h"

namespace scattermeter::apps {

BenchFiles::BenchFiles(const BenchOptions& options, CommandContext& context)
    : out_(options.out), context_(context) {}

void BenchFiles::table(const std::string& text) {
  if (!context_.quiet) context_.out << text;
}

void BenchFiles::csv(const std::string& name, const std::string& text) {
  write_text_file(path(name + ".csv"), text);
}

void BenchFiles::plot(const std::string& name, const Plot& plot) {
  for (const char* extension : {".png", ".svg"}) write_plot(plot, path(name + extension));
}

std::string BenchFiles::path(const std::string& name) {
  const std::string path = out_ + "/" + name;
  if (!context_.quiet) context_.out << "writing " << path << "\n";
  return path;
}

}  // namespace scattermeter::apps
