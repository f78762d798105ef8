#include "apps/drafting/shot_listing.h"

#include <filesystem>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "capture/raw/raw_reader.h"
#include "capture/shots/shot_folder.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

struct Read {
  std::optional<ListedShot> shot;
  std::string model, problem;
  int width_px = 0, height_px = 0;
};

Read read(const std::string& folder, const std::string& name) {
  Read out;
  try {
    const capture::RawFrame frame =
        capture::read_raw((std::filesystem::path(folder) / name).string());
    out.shot = {name, frame.exposure_s, frame.iso, frame.f_number};
    out.model = frame.model.starts_with(frame.make) ? frame.model : frame.make + " " + frame.model;
    out.width_px = frame.width_px;
    out.height_px = frame.height_px;
  } catch (const InputError& e) {
    out.problem = e.what();
  }
  return out;
}

}  // namespace

ShotListing list_shots(const std::string& folder) {
  const std::set<std::string> files = capture::files_of_shots(folder);
  const std::vector<std::string> names(files.begin(), files.end());
  std::vector<Read> all(names.size());
  tbb::parallel_for(std::size_t{0}, names.size(),
                    [&](std::size_t i) { all[i] = read(folder, names[i]); });
  ShotListing out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Read& r = all[i];
    if (!r.shot) {
      out.skipped.push_back(r.problem);
      continue;
    }
    if (out.shots.empty()) {
      out.model = r.model;
      out.width_px = r.width_px;
      out.height_px = r.height_px;
    } else if (r.model != out.model || r.width_px != out.width_px || r.height_px != out.height_px) {
      throw InputError(names[i], fmt::format("is {} x {} px from {}, but {} is {} x {} px from {}: "
                                             "a rig has one camera",
                                             r.width_px, r.height_px, r.model, out.shots[0].file,
                                             out.width_px, out.height_px, out.model));
    }
    out.shots.push_back(*r.shot);
  }
  if (!out.shots.empty()) return out;
  throw InputError(folder, "has no raw that can be read: " + out.skipped[0]);
}

}  // namespace scattermeter::apps
