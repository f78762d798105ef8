#include "apps/rig/rig_camera_calibration.h"

#include <set>

#include "apps/rig/rig_fields.h"
#include "apps/rig/rig_limits.h"

namespace scattermeter::apps {
namespace {

calib::CalibrationBoard read_calibration_board(const YamlField& field) {
  calib::CalibrationBoard board;
  const YamlField type = field.at("type");
  const std::string name = type.text();
  if (name != "chessboard" && name != "charuco") type.fail("expected chessboard or charuco");
  const bool charuco = name == "charuco";
  if (charuco) {
    field.only({"type", "squares", "square_mm", "marker_mm", "dictionary"});
  } else {
    field.only({"type", "squares", "square_mm"});
  }
  board.kind = charuco ? calib::BoardKind::kCharuco : calib::BoardKind::kChessboard;
  const std::array<int, 2> squares = integer_pair(field.at("squares"), 2, 1000);
  board.squares_x = squares[0];
  board.squares_y = squares[1];
  board.square_mm = field.at("square_mm").positive();
  require_mm(field.at("square_mm"), board.square_mm, 0.1);
  if (charuco) {
    board.marker_mm = field.at("marker_mm").positive();
    if (const auto f = field.find("dictionary")) board.dictionary = f->text();
  }
  if (const std::string problem = calib::calibration_board_problem(board); !problem.empty()) {
    field.fail(problem);
  }
  return board;
}

calib::BoardShot read_board_shot(const YamlField& field) {
  field.only({"file", "position_mm", "look_at_mm", "up"});
  calib::BoardShot shot;
  shot.line = field.line();
  shot.file = file_in_folder(field.at("file"));
  if (field.find("position_mm") || field.find("look_at_mm") || field.find("up")) {
    shot.viewpoint = read_viewpoint(field);
  }
  return shot;
}

}  // namespace

calib::BoardShots read_camera_calibration(const YamlField& field, const std::string& rig_path) {
  field.only({"board", "board_std_mm", "shots"});
  calib::BoardShots calibration;
  calibration.path = rig_path;
  calibration.line = field.line();
  calibration.board = read_calibration_board(field.at("board"));
  if (const auto f = field.find("board_std_mm")) {
    calibration.board_std_mm = f->number(0.0, calibration.board.square_mm);
  }
  std::set<std::string> files;
  const YamlField shots = field.at("shots");
  for (const YamlField& shot : shots.items()) {
    calibration.shots.push_back(read_board_shot(shot));
    if (!files.insert(calibration.shots.back().file).second) {
      shot.at("file").fail("two shots of the same name");
    }
  }
  if (calibration.shots.empty()) shots.fail("expected at least one shot");
  return calibration;
}

RigCameraToCalibrate read_camera_to_calibrate(const std::string& rig_path) {
  const YamlField top = YamlField::load(rig_path);
  require_version(top, "scattermeter_rig", "rigs");
  const YamlField camera = top.at("camera");
  RigCameraToCalibrate out;
  if (const auto f = camera.find("model")) out.model = f->text();
  const YamlField size = camera.at("image_size_px");
  const std::array<int, 2> pixels = integer_pair(size, 2, 100'000);
  out.width_px = pixels[0];
  out.height_px = pixels[1];
  const RigLimits limits = read_limits(top);
  check_image_size(size, limits);
  out.max_megapixels = limits.raw_megapixels;
  out.calibration = read_camera_calibration(top.at("calibration").at("camera"), rig_path);
  return out;
}

}  // namespace scattermeter::apps
