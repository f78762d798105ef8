#include "apps/bench_transport/atlas_size.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include <fmt/core.h>
#include <malloc.h>
#include <unistd.h>

#include "apps/bench_transport/lit_body.h"
#include "apps/instrument/atlas_folder.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

// Of the program, now, in bytes; what was freed has been given back.
double resident_bytes() {
  malloc_trim(0);
  double total_pages = 0.0, pages = 0.0;
  std::ifstream("/proc/self/statm") >> total_pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double bytes_in(const std::string& folder) {
  double out = 0.0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) out += static_cast<double>(entry.file_size());
  }
  return out;
}

int node_below(double sigma_s_per_mm) {
  return static_cast<int>(std::floor(std::log(sigma_s_per_mm) / TransportAtlas::kSpacing));
}

Eigen::Index rows_of(const WhiteRows& node) { return node.sums().sum.cols(); }

AtlasSizeRow size_of_atlas(const std::string& name, const AtlasSizeOptions& options) {
  const int middle = node_below(1.0);
  // From the number of patches of a known size, in proportion to their area.
  LitBodyOptions body_options{.image_width_px = options.image_width_px, .patch_size_mm = 2.0};
  {
    TransportAtlas in_memory;
    const auto large =
        static_cast<double>(rows_of(*LitBody(name, body_options).in(in_memory).node(middle, 1)));
    body_options.patch_size_mm *= std::sqrt(large / options.rows);
  }
  const LitBody body(name, body_options);
  const std::string folder = options.folder + "/" + name;
  if (fs::exists(folder)) throw std::invalid_argument("atlas_size: " + folder + " exists");

  AtlasSizeRow row;
  row.body = name;
  TransportAtlas atlas(std::make_shared<AtlasFolder>(folder));
  TransportAtlas::LitView& lit = body.in(atlas);
  const int first = node_below(0.2) - 1, last = node_below(10.0) + 2;
  row.nodes = last - first + 1;
  const double before = resident_bytes();
  for (int node = middle - 1; node <= middle + 2; ++node) row.rows = rows_of(*lit.node(node, 1));
  row.medium_bytes = resident_bytes() - before;
  for (int node = first; node <= last; ++node) lit.node(node, 1);
  row.all_bytes = resident_bytes() - before;
  row.disk_bytes = bytes_in(folder);
  return row;
}

}  // namespace

std::vector<AtlasSizeRow> atlas_size(const AtlasSizeOptions& options) {
  if (options.rows < 100) {
    throw std::invalid_argument("atlas_size: rows " + std::to_string(options.rows));
  }
  std::vector<AtlasSizeRow> rows;
  ProgressStage stage(options.progress, "size of the atlas", options.bodies.size());
  for (const std::string& body : options.bodies) {
    rows.push_back(size_of_atlas(body, options));
    stage.step();
  }
  return rows;
}

std::string atlas_size_table(const std::vector<AtlasSizeRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"body", Align::kLeft},
                   {"rows"},
                   {"nodes"},
                   {"on disk MB"},
                   {"of a medium MB"},
                   {"of all MB"},
                   {"10^5 rows: on disk GB"},
                   {"of a medium GB"}});
  for (const AtlasSizeRow& r : rows) {
    const double more = 1e5 / static_cast<double>(r.rows);
    table.add_row({r.body, std::to_string(r.rows), std::to_string(r.nodes),
                   fmt::format("{:.1f}", 1e-6 * r.disk_bytes),
                   fmt::format("{:.1f}", 1e-6 * r.medium_bytes),
                   fmt::format("{:.1f}", 1e-6 * r.all_bytes),
                   fmt::format("{:.2f}", 1e-9 * more * r.disk_bytes),
                   fmt::format("{:.2f}", 1e-9 * more * r.medium_bytes)});
  }
  return table.text();
}

std::string atlas_size_csv(const std::vector<AtlasSizeRow>& rows) {
  Csv csv({"body", "rows", "nodes", "disk_bytes", "medium_bytes", "all_bytes"});
  for (const AtlasSizeRow& r : rows) {
    csv.add_row({r.body, std::to_string(r.rows), std::to_string(r.nodes), csv_number(r.disk_bytes),
                 csv_number(r.medium_bytes), csv_number(r.all_bytes)});
  }
  return csv.text();
}

}  // namespace scattermeter::apps
