#include "apps/calibrate_camera.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>
#include <unistd.h>

#include "apps/camera_calibration_pictures.h"
#include "apps/file_kind.h"
#include "apps/grey_picture.h"
#include "apps/raw_shot.h"
#include "apps/rig_camera_calibration.h"
#include "apps/text_table.h"
#include "apps/version.h"
#include "calib/camera_calibration_file.h"
#include "capture/pending_file.h"
#include "core/input_error.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

struct BoardShot {
  std::string path;
  std::string name;
  calib::BoardView view;
  int width_px = 0;
  int height_px = 0;
  std::string fault;  // why it cannot be used
};

std::vector<std::string> files_of_folder(const std::string& folder) {
  std::vector<std::string> files;
  try {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with('.') && !entry.is_directory()) files.push_back(entry.path().string());
    }
  } catch (const fs::filesystem_error& e) {
    throw InputError(folder, "the folder of shots cannot be read: " + e.code().message());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw InputError(folder, "the folder of shots is empty");
  return files;
}

std::vector<std::string> files_of_rig(const CalibrateCameraOptions& options,
                                      const RigCameraCalibration& calibration) {
  if (options.shots.size() != 1 || !is_folder(options.shots.front())) {
    throw InputError(options.shots.front(), "is not the folder of the rig's shots");
  }
  std::vector<std::string> files;
  std::string missing;
  int first_line = 0;
  for (const RigBoardShot& shot : calibration.shots) {
    files.push_back((fs::path(options.shots.front()) / shot.file).string());
    if (is_there(files.back())) continue;
    missing += (missing.empty() ? "" : ", ") + shot.file;
    if (first_line == 0) first_line = shot.line;
  }
  if (!missing.empty()) {
    throw InputError(fmt::format("{}:{}: calibration.camera.shots.file", options.rig, first_line),
                     "listed, but not in the folder " + options.shots.front() + ": " + missing);
  }
  return files;
}

void read_shot_of_board(const calib::CalibrationBoard& board, const std::string& model,
                        double max_megapixels, bool must_be_picture, BoardShot* shot) {
  GreyPicture picture;
  try {
    picture = read_grey_picture(shot->path, max_megapixels);
  } catch (const InputError& error) {
    if (must_be_picture) throw;
    const std::string problem = error.what();  // "path: what is wrong"
    shot->fault = problem.substr(std::min(problem.size(), shot->path.size() + 2));
    return;
  }
  shot->width_px = picture.frame_width_px;
  shot->height_px = picture.frame_height_px;
  if (!model.empty() && !picture.model.empty() &&
      !same_camera(model, picture.make, picture.model)) {
    shot->fault =
        fmt::format("shot with a {} {}, not with the rig's {}", picture.make, picture.model, model);
    return;
  }
  shot->view = {shot->name,
                calib::find_board_corners(board, picture.grey, picture.width_px, picture.height_px,
                                          picture.px_scale, picture.px_offset)};
  if (shot->view.corners.empty()) shot->fault = "the board is not seen";
}

// The size that most have; the first such.
std::pair<int, int> common_size(const std::vector<BoardShot>& shots) {
  std::map<std::pair<int, int>, int> count;
  std::pair<int, int> best{0, 0};
  for (const BoardShot& s : shots) {
    if (s.width_px > 0) ++count[{s.width_px, s.height_px}];
  }
  for (const BoardShot& s : shots) {
    const std::pair<int, int> size{s.width_px, s.height_px};
    if (s.width_px > 0 && (best.first == 0 || count[size] > count[best])) best = size;
  }
  return best;
}

void write_text(const std::string& path, const std::string& text) {
  capture::PendingFile file(path);
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = ::write(file.descriptor(), text.data() + at, text.size() - at);
    if (n <= 0) throw InputError(path, "cannot be written");
    at += static_cast<std::size_t>(n);
  }
  file.commit();
}

std::string board_name(const calib::CalibrationBoard& board) {
  const bool charuco = board.kind == calib::BoardKind::kCharuco;
  return fmt::format("{} board of {} x {} squares of {:g} mm", charuco ? "ChArUco" : "chess",
                     board.squares_x, board.squares_y, board.square_mm);
}

void write_results(const CalibrateCameraOptions& options, CameraCalibrationRun* run) {
  write_text(options.out, calib::camera_calibration_text(
                              run->calibration,
                              {fmt::format("scattermeter {}: {}", kVersion, options.command_line),
                               board_name(run->board)}));
  run->written.push_back(options.out);
  const fs::path stem = fs::path(options.out).replace_extension();
  for (const auto& [draw, ending] : {std::pair(&draw_camera_residuals, "_residuals.png"),
                                     std::pair(&draw_camera_coverage, "_coverage.png")}) {
    const std::string path = stem.string() + ending;
    try {
      draw(run->calibration, path);
      run->written.push_back(path);
    } catch (const InputError& error) {
      run->notes.emplace_back(error.what());  // the calibration stands without its picture
    }
  }
}

}  // namespace

CameraCalibrationRun calibrate_camera_shots(const CalibrateCameraOptions& options) {
  CameraCalibrationRun run;
  run.board = options.board;
  calib::CameraCalibrationOptions calib_options{options.board_std_mm, options.model};
  std::string model;
  double max_megapixels = options.max_megapixels;
  std::pair<int, int> size{0, 0};
  std::vector<std::string> files = options.shots;
  bool must_be_picture = true;
  if (!options.rig.empty()) {
    const RigCameraToCalibrate rig = read_camera_to_calibrate(options.rig);
    run.board = rig.calibration.board;
    calib_options.board_std_mm = rig.calibration.board_std_mm;
    model = rig.model;
    max_megapixels = rig.max_megapixels;
    size = {rig.width_px, rig.height_px};
    files = files_of_rig(options, rig.calibration);
  } else if (options.shots.size() == 1 && is_folder(options.shots.front())) {
    files = files_of_folder(options.shots.front());
    must_be_picture = false;
  }
  std::map<std::string, int> of_name;
  for (const std::string& file : files) ++of_name[fs::path(file).filename().string()];
  std::vector<BoardShot> shots;
  for (const std::string& file : files) {
    const std::string name = fs::path(file).filename().string();
    shots.push_back({file, of_name[name] > 1 ? file : name, {}, 0, 0, {}});
    for (std::size_t i = 0; i + 1 < shots.size(); ++i) {
      if (shots[i].path == file) throw InputError(file, "is given twice");
    }
  }
  tbb::parallel_for(std::size_t{0}, shots.size(), [&](std::size_t i) {
    read_shot_of_board(run.board, model, max_megapixels, must_be_picture, &shots[i]);
  });
  run.n_shots = shots.size();
  if (size.first == 0) size = common_size(shots);
  if (size.first == 0) throw InputError(options.shots.front(), "holds no picture that can be read");
  std::vector<calib::BoardView> views;
  std::vector<calib::LeftOutView> left_out;
  for (BoardShot& shot : shots) {
    const std::pair<int, int> own{shot.width_px, shot.height_px};
    if (shot.width_px > 0 && own != size) {
      shot.fault =
          fmt::format("{} x {} px, not {} x {} px as {}", own.first, own.second, size.first,
                      size.second, options.rig.empty() ? "most" : "the rig says");
    }
    if (shot.fault.empty()) {
      views.push_back(std::move(shot.view));
    } else {
      left_out.push_back({shot.name, shot.fault});
    }
  }
  run.calibration = calib::calibrate_camera(views, size.first, size.second, calib_options);
  run.calibration.left_out.insert(run.calibration.left_out.begin(), left_out.begin(),
                                  left_out.end());
  if (run.calibration.status == calib::CameraCalibrationStatus::kOk) write_results(options, &run);
  return run;
}

std::string camera_calibration_table(const CameraCalibrationRun& run) {
  const calib::CameraCalibration& c = run.calibration;
  std::string text = fmt::format("{}, {} shots\n", board_name(run.board), run.n_shots);
  for (const calib::LeftOutView& view : c.left_out) {
    text += fmt::format("left out: {}: {}\n", view.name, view.reason);
  }
  for (const calib::LeftOutCorner& corner : c.corners_left_out) {
    text += fmt::format("left out: a corner of {} at ({:.1f}, {:.1f}): {:.2f} px off\n",
                        corner.view, corner.image_px.x(), corner.image_px.y(), corner.distance_px);
  }
  if (c.status != calib::CameraCalibrationStatus::kOk) return text;
  using Align = TextTable::Align;
  TextTable values({{"", Align::kLeft}, {"value"}, {"std"}, {"unit", Align::kLeft}});
  for (std::size_t i = 0; i < c.parameters.size(); ++i) {
    const std::string& name = c.parameters[i];
    const bool px = name.ends_with("_px");
    values.add_row({px ? name.substr(0, name.size() - 3) : name,
                    px ? fmt::format("{:.3f}", c.value(i)) : fmt::format("{:.5f}", c.value(i)),
                    px ? fmt::format("{:.3f}", c.std(i)) : fmt::format("{:.5f}", c.std(i)),
                    px ? "px" : "1"});
  }
  text += "\n" + values.text();
  const auto worst =
      std::max_element(c.views.begin(), c.views.end(),
                       [](const auto& a, const auto& b) { return a.worst_px < b.worst_px; });
  text +=
      fmt::format("\nresiduals of {} corners in {} views: rms {:.3f} px, worst {:.3f} px ({})\n",
                  c.residuals.size(), c.views.size(), c.rms_px, c.worst_px, worst->name);
  if (c.widened) {
    text += fmt::format(
        "the views differ {:.1f} times as much as their corners' noise explains (a bent board, "
        "blur): the std above are that much wider\n",
        std::sqrt(c.view_scatter));
  }
  text += fmt::format("a ray's image is known to {:.2f} px (std) at the frame's worst corner\n\n",
                      c.frame_corner_std_px);
  TextTable models(
      {{"lens model", Align::kLeft}, {"rms, px"}, {"left-out views, px"}, {"", Align::kLeft}});
  for (std::size_t i = 0; i < c.candidates.size(); ++i) {
    const calib::LensCandidate& m = c.candidates[i];
    const bool good = m.fault.empty();
    models.add_row({calib::lens_model_name(m.model),
                    m.rms_px > 0 ? fmt::format("{:.4f}", m.rms_px) : "-",
                    good ? fmt::format("{:.4f}", m.left_out_rms_px) : "-",
                    i == c.chosen ? "chosen" : m.fault});
  }
  text += models.text();
  for (const std::string& warning : c.warnings) text += "warning: " + warning + "\n";
  for (const std::string& note : run.notes) text += "note: " + note + "\n";
  for (const std::string& path : run.written) text += "written: " + path + "\n";
  return text;
}

}  // namespace scattermeter::apps
