#include <filesystem>
#include <memory>
#include <ostream>
#include <utility>

#include <fmt/core.h>

#include "apps/commands/commands.h"
#include "apps/instrument/calibration_inputs.h"
#include "apps/pages/calibration_page.h"
#include "apps/report/calibration_tables.h"
#include "apps/report/camera_calibration_pictures.h"
#include "apps/results/result_json.h"
#include "calib/lens/calibrate_camera.h"
#include "calib/lens/camera_calibration_file.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"
#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

struct CameraArguments {
  std::string rig, out, board, squares, corners;
  calib::CalibrateCameraOptions run;
};

// "10x7" as two integers.
std::pair<int, int> read_counts(const std::string& option, const std::string& text) {
  const std::size_t cross = text.find_first_of("xX");
  const auto number = [&](const std::string& digits) {
    if (digits.empty() || digits.size() > 3 ||
        digits.find_first_not_of("0123456789") != std::string::npos) {
      throw InputError(option, "expected two integers such as 10x7, got " + text);
    }
    return std::stoi(digits);
  };
  if (cross == std::string::npos) number("");
  return {number(text.substr(0, cross)), number(text.substr(cross + 1))};
}

// Sets kind and size of the board; its lengths and dictionary are set already.
void complete_board(CameraArguments& a) {
  calib::CalibrationBoard& board = a.run.board;
  if (a.board.empty()) throw InputError("--board", "is missing (or --rig)");
  const bool by_squares = !a.squares.empty();
  if (!by_squares && a.corners.empty()) {
    throw InputError("--squares", "is missing (or --corners, or --rig)");
  }
  const auto [nx, ny] =
      by_squares ? read_counts("--squares", a.squares) : read_counts("--corners", a.corners);
  board.kind = a.board == "charuco" ? calib::BoardKind::kCharuco : calib::BoardKind::kChessboard;
  board.squares_x = by_squares ? nx : nx + 1;
  board.squares_y = by_squares ? ny : ny + 1;
  if (const std::string problem = calib::calibration_board_problem(board); !problem.empty()) {
    throw InputError("the board's options", problem);
  }
}

// Writes the file and, next to it, the pictures; returns lines for the user.
std::string write_camera(const calib::CameraCalibration& calibration, const std::string& path,
                         const std::vector<std::string>& comments) {
  capture::write_text_file(path, calib::camera_calibration_text(calibration, comments));
  std::string notes;
  std::string written = "written: " + path + "\n";
  const std::string stem = std::filesystem::path(path).replace_extension().string();
  for (const auto& [plot, ending] :
       {std::pair(camera_residual_plot(calibration), "_residuals.png"),
        std::pair(camera_coverage_plot(calibration), "_coverage.png")}) {
    const std::string note = note_unless_drawn(plot, stem + ending);
    (note.empty() ? written : notes) += note.empty() ? "written: " + stem + ending + "\n" : note;
  }
  return notes + written;
}

void declare_options(CLI::App& command, CameraArguments& a) {
  calib::CalibrationBoard& of_board = a.run.board;
  command
      .add_option("SHOTS", a.run.shots,
                  "folder of the shots, or the files themselves (with --rig: the folder)")
      ->required();
  command
      .add_option("--out", a.out,
                  "file to write (YAML), with pictures and a page (HTML) next to it")
      ->required();
  CLI::Option* rig = command.add_option("--rig", a.rig, "rig file (YAML) with calibration.camera");
  CLI::Option* board = command.add_option("--board", a.board, "without --rig: kind of the board")
                           ->check(CLI::IsMember({"chessboard", "charuco"}))
                           ->excludes(rig);
  CLI::Option* squares =
      command.add_option("--squares", a.squares, "squares across and down, such as 10x7")
          ->excludes(rig);
  command
      .add_option("--corners", a.corners, "inner corners instead, such as 9x6 (one less each way)")
      ->excludes(rig)
      ->excludes(squares);
  command.add_option("--square-mm", of_board.square_mm, "side of a square")
      ->check(CLI::PositiveNumber)
      ->needs(board);
  command.add_option("--marker-mm", of_board.marker_mm, "charuco: side of a marker")
      ->check(CLI::PositiveNumber)
      ->needs(board);
  command
      .add_option("--dictionary", of_board.dictionary,
                  "charuco: OpenCV's name of the dictionary of the markers")
      ->needs(board)
      ->capture_default_str();
  command
      .add_option("--board-std-mm", a.run.board_std_mm,
                  "standard deviation of each coordinate of a printed corner")
      ->check(CLI::NonNegativeNumber)
      ->excludes(rig)
      ->capture_default_str();
  command
      .add_option("--max-megapixels", a.run.max_megapixels,
                  "a shot that claims more is refused before memory is allocated for it (with "
                  "--rig: limits.raw_megapixels)")
      ->check(CLI::Range(1e-6, 2000.0))
      ->excludes(rig)
      ->capture_default_str();
}

int run_calibrate_camera(CameraArguments a, CommandContext& context) {
  std::vector<std::string> inputs = a.run.shots;
  inputs.push_back(a.rig);
  capture::require_output_file(a.out, inputs);
  if (a.rig.empty()) {
    complete_board(a);
  } else {
    if (a.run.shots.size() != 1) {
      throw InputError(a.run.shots.front(), "is not the folder of the rig's shots");
    }
    a.run = camera_calibration_input(a.rig, a.run.shots.front());
  }
  const calib::CameraCalibrationRun run = calib::calibrate_camera_shots(a.run);
  const bool ok = run.calibration.status == calib::CameraCalibrationStatus::kOk;
  std::string text = camera_calibration_table(a.run.board, run);
  if (ok) {
    const std::string page = calibration_page(
        {"Camera calibration",
         fmt::format(
             "The lens is known: residuals of {:.2f} px in {} views, {:.2f} px (one standard "
             "deviation) at the worst corner of the frame.",
             run.calibration.rms_px, run.calibration.views.size(),
             run.calibration.frame_corner_std_px),
         fmt::format("In the rig: camera: {{intrinsics: {}}}", a.out),
         true,
         text,
         {{camera_residual_plot(run.calibration),
           "Residuals (projected - found) of the corners, magnified."},
          {camera_coverage_plot(run.calibration), "The corners that were found, by view."}}},
        context.command_line);
    text += write_camera(run.calibration, a.out,
                         {fmt::format("scattermeter {}: {}", kVersion, context.command_line),
                          board_name(a.run.board)});
    text += write_page_beside(a.out, page);
  }
  if (!context.quiet) context.out << text;
  if (ok) return 0;
  context.err << "scattermeter: refused, nothing is written: " << run.calibration.message << "\n";
  return 1;
}

}  // namespace

void add_calibrate_camera(CLI::App& calibrate, CommandContext& context) {
  CLI::App* command = calibrate.add_subcommand(
      "camera",
      "Focal length, centre and distortion from shots of a flat board (raws, or jpg, png, tif).\n"
      "The board and the shots are those of the rig's calibration.camera, or given by options. "
      "The\n"
      "written file serves as the rig's camera.intrinsics; OpenCV can read it, too. The terms of\n"
      "the distortion are chosen by cross-validation over the views.\n"
      "Exit status: 0 done, 1 the shots do not determine the lens, 2 bad input.");
  const auto arguments = std::make_shared<CameraArguments>();
  declare_options(*command, *arguments);
  run_if_named(*command, context,
               [arguments, &context] { return run_calibrate_camera(*arguments, context); });
}

}  // namespace scattermeter::apps
