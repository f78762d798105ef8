#include "calib/lens/calibrate_camera.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "calib/board/grey_picture.h"
#include "capture/files/file_kind.h"
#include "capture/shots/same_camera.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNotSeen = "the board is not seen";

struct OpenedBoardShot {
  std::string path;
  std::string name;
  BoardView view;
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

// A shot is named by its file name, or by its path if several files have the same name.
std::vector<OpenedBoardShot> named_shots(const std::vector<std::string>& files) {
  std::map<std::string, int> of_name;
  for (const std::string& file : files) ++of_name[fs::path(file).filename().string()];
  std::vector<OpenedBoardShot> shots;
  for (const std::string& file : files) {
    for (const OpenedBoardShot& shot : shots) {
      if (shot.path == file) throw InputError(file, "is given twice");
    }
    const std::string name = fs::path(file).filename().string();
    shots.push_back({file, of_name[name] > 1 ? file : name, {}, 0, 0, {}});
  }
  return shots;
}

void open_board_shot(const CalibrateCameraOptions& options, bool must_be_picture,
                     OpenedBoardShot* shot) {
  GreyPicture picture;
  try {
    picture = read_grey_picture(shot->path, options.max_megapixels);
  } catch (const InputError& error) {
    if (must_be_picture) throw;
    const std::string problem = error.what();  // "path: what is wrong"
    shot->fault = problem.substr(std::min(problem.size(), shot->path.size() + 2));
    return;
  }
  shot->width_px = picture.frame_width_px;
  shot->height_px = picture.frame_height_px;
  if (!options.camera.empty() && !picture.model.empty() &&
      !capture::same_camera(options.camera, picture.make, picture.model)) {
    shot->fault = fmt::format("shot with a {} {}, not with the rig's {}", picture.make,
                              picture.model, options.camera);
    return;
  }
  shot->view = {shot->name,
                find_board_corners(options.board, picture.grey, picture.width_px, picture.height_px,
                                   picture.px_scale, picture.px_offset)};
  if (shot->view.corners.empty()) shot->fault = kNotSeen;
}

// What to say when no shot shows the board: whether one does if its squares were counted as corners
// or its corners as squares. At most this many shots are tried again, as the search takes a second.
constexpr std::size_t kTriedAgain = 3;

std::string other_count(const CalibrateCameraOptions& options,
                        const std::vector<OpenedBoardShot>& shots) {
  if (options.board.kind != BoardKind::kChessboard) return "";
  std::size_t tried = 0;
  for (const OpenedBoardShot& shot : shots) {
    if (shot.fault != kNotSeen) continue;
    if (tried++ == kTriedAgain) break;
    const GreyPicture picture = read_grey_picture(shot.path, options.max_megapixels);
    for (const int more : {1, -1}) {
      CalibrationBoard board = options.board;
      board.squares_x += more;
      board.squares_y += more;
      if (!calibration_board_problem(board).empty()) continue;
      if (find_board_corners(board, picture.grey, picture.width_px, picture.height_px,
                             picture.px_scale, picture.px_offset)
              .empty()) {
        continue;
      }
      return fmt::format(
          "; {} shows a board of {} x {} squares, which has {} x {} inner corners: one was given "
          "for the other",
          shot.name, board.squares_x, board.squares_y, board.squares_x - 1, board.squares_y - 1);
    }
  }
  return "";
}

// The most frequent size; the first of several.
std::pair<int, int> common_size(const std::vector<OpenedBoardShot>& shots) {
  std::map<std::pair<int, int>, int> count;
  std::pair<int, int> best{0, 0};
  for (const OpenedBoardShot& s : shots) {
    if (s.width_px > 0) ++count[{s.width_px, s.height_px}];
  }
  for (const OpenedBoardShot& s : shots) {
    const std::pair<int, int> size{s.width_px, s.height_px};
    if (s.width_px > 0 && (best.first == 0 || count[size] > count[best])) best = size;
  }
  return best;
}

}  // namespace

CameraCalibrationRun calibrate_camera_shots(const CalibrateCameraOptions& options) {
  const bool in_folder = options.shots.size() == 1 && capture::is_folder(options.shots.front());
  std::vector<OpenedBoardShot> shots =
      named_shots(in_folder ? files_of_folder(options.shots.front()) : options.shots);
  tbb::parallel_for(std::size_t{0}, shots.size(),
                    [&](std::size_t i) { open_board_shot(options, !in_folder, &shots[i]); });
  const bool size_given = options.width_px > 0;
  const auto size =
      size_given ? std::pair(options.width_px, options.height_px) : common_size(shots);
  if (size.first == 0) throw InputError(options.shots.front(), "contains no readable picture");
  std::vector<BoardView> views;
  std::vector<LeftOutView> left_out;
  for (OpenedBoardShot& shot : shots) {
    const std::pair<int, int> own{shot.width_px, shot.height_px};
    if (shot.width_px > 0 && own != size) {
      shot.fault = fmt::format("{} x {} px, not {} x {} px as {}", own.first, own.second,
                               size.first, size.second, size_given ? "the rig says" : "most");
    }
    if (shot.fault.empty()) {
      views.push_back(std::move(shot.view));
    } else {
      left_out.push_back({shot.name, shot.fault});
    }
  }
  const bool none_seen =
      std::ranges::none_of(shots, [](const OpenedBoardShot& shot) { return shot.fault.empty(); });
  CameraCalibrationRun run;
  run.n_shots = shots.size();
  run.calibration =
      calibrate_camera(views, size.first, size.second, {options.board_std_mm, options.model});
  if (none_seen && run.calibration.status == CameraCalibrationStatus::kTooFewViews) {
    run.calibration.message += other_count(options, shots);
  }
  run.calibration.left_out.insert(run.calibration.left_out.begin(), left_out.begin(),
                                  left_out.end());
  return run;
}

}  // namespace scattermeter::calib
