#include <filesystem>
#include <memory>
#include <ostream>
#include <utility>

#include <fmt/core.h>

#include "apps/commands/commands.h"
#include "apps/instrument/calibration_inputs.h"
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

// "10x7" as two whole numbers.
std::pair<int, int> read_counts(const std::string& option, const std::string& text) {
  const std::size_t cross = text.find_first_of("xX");
  const auto number = [&](const std::string& digits) {
    if (digits.empty() || digits.size() > 3 ||
        digits.find_first_not_of("0123456789") != std::string::npos) {
      throw InputError(option, "expected two whole numbers like 10x7, got " + text);
    }
    return std::stoi(digits);
  };
  if (cross == std::string::npos) number("");
  return {number(text.substr(0, cross)), number(text.substr(cross + 1))};
}

// The board of the options; those that are numbers of their own are in it already.
void complete_board(const std::string& kind, const std::string& squares, const std::string& corners,
                    calib::CalibrationBoard& board) {
  if (kind.empty()) throw InputError("--board", "is missing (or --rig)");
  const bool by_squares = !squares.empty();
  if (!by_squares && corners.empty()) {
    throw InputError("--squares", "is missing (or --corners, or --rig)");
  }
  const auto [nx, ny] =
      by_squares ? read_counts("--squares", squares) : read_counts("--corners", corners);
  board.kind = kind == "charuco" ? calib::BoardKind::kCharuco : calib::BoardKind::kChessboard;
  board.squares_x = by_squares ? nx : nx + 1;
  board.squares_y = by_squares ? ny : ny + 1;
  if (const std::string problem = calib::calibration_board_problem(board); !problem.empty()) {
    throw InputError("the board's options", problem);
  }
}

// The file and, beside it, the pictures; lines for the user.
std::string write_camera(const calib::CameraCalibration& calibration, const std::string& path,
                         const std::vector<std::string>& comments) {
  capture::write_text_file(path, calib::camera_calibration_text(calibration, comments));
  std::string notes;
  std::string written = "written: " + path + "\n";
  const std::string stem = std::filesystem::path(path).replace_extension().string();
  for (const auto& [draw, ending] : {std::pair(&draw_camera_residuals, "_residuals.png"),
                                     std::pair(&draw_camera_coverage, "_coverage.png")}) {
    try {
      draw(calibration, stem + ending);
      written += "written: " + stem + ending + "\n";
    } catch (const InputError& error) {
      notes += std::string("note: ") + error.what() + "\n";  // the file is valid without it
    }
  }
  return notes + written;
}

}  // namespace

void add_calibrate_camera(CLI::App& calibrate, CommandContext& context) {
  struct Options {
    std::string rig, out, board, squares, corners;
    calib::CalibrateCameraOptions run;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = calibrate.add_subcommand(
      "camera",
      "Focal length, centre and distortion from shots of a flat board (raws, or jpg, png, tif).\n"
      "Board and shots are those of the rig's calibration.camera, or given by the options. The\n"
      "written file serves as the rig's camera.intrinsics; OpenCV reads it, too. Terms of\n"
      "distortion are chosen by cross-validation over the views.\n"
      "Exit status: 0 done, 1 the shots do not determine the lens, 2 bad input.");
  command
      ->add_option("SHOTS", options->run.shots,
                   "folder of the shots, or the files themselves (with --rig: the folder)")
      ->required();
  command->add_option("--out", options->out, "file to write (YAML); pictures beside it")
      ->required();
  CLI::Option* rig =
      command->add_option("--rig", options->rig, "rig file (YAML) with calibration.camera");
  CLI::Option* board = command->add_option("--board", options->board, "without --rig: its kind")
                           ->check(CLI::IsMember({"chessboard", "charuco"}))
                           ->excludes(rig);
  CLI::Option* squares =
      command->add_option("--squares", options->squares, "squares across and down, such as 10x7")
          ->excludes(rig);
  command
      ->add_option("--corners", options->corners,
                   "inner corners instead, such as 9x6 (one less each way)")
      ->excludes(rig)
      ->excludes(squares);
  command->add_option("--square-mm", options->run.board.square_mm, "side of a square")
      ->check(CLI::PositiveNumber)
      ->needs(board);
  command->add_option("--marker-mm", options->run.board.marker_mm, "charuco: side of a marker")
      ->check(CLI::PositiveNumber)
      ->needs(board);
  command
      ->add_option("--dictionary", options->run.board.dictionary,
                   "charuco: OpenCV's name of the markers' dictionary")
      ->needs(board)
      ->capture_default_str();
  command
      ->add_option("--board-std-mm", options->run.board_std_mm,
                   "standard deviation of a printed corner, each coordinate")
      ->check(CLI::NonNegativeNumber)
      ->excludes(rig)
      ->capture_default_str();
  command
      ->add_option("--max-megapixels", options->run.max_megapixels,
                   "a shot that claims more is refused before memory is taken for it (with --rig: "
                   "limits.raw_megapixels)")
      ->check(CLI::Range(1e-6, 2000.0))
      ->excludes(rig)
      ->capture_default_str();
  command->callback([options, &context] {
    context.chosen = [options, &context] {
      if (!options->rig.empty()) {
        if (options->run.shots.size() != 1) {
          throw InputError(options->run.shots.front(), "is not the folder of the rig's shots");
        }
        options->run = camera_calibration_input(options->rig, options->run.shots.front());
      } else {
        complete_board(options->board, options->squares, options->corners, options->run.board);
      }
      const calib::CameraCalibrationRun run = calib::calibrate_camera_shots(options->run);
      const calib::CalibrationBoard& used = options->run.board;
      const bool ok = run.calibration.status == calib::CameraCalibrationStatus::kOk;
      std::string text = camera_calibration_table(used, run);
      if (ok) {
        text += write_camera(
            run.calibration, options->out,
            {fmt::format("scattermeter {}: {}", kVersion, context.command_line), board_name(used)});
      }
      if (!context.quiet) context.out << text;
      if (ok) return 0;
      context.err << "scattermeter: refused, nothing is written: " << run.calibration.message
                  << "\n";
      return 1;
    };
  });
}

}  // namespace scattermeter::apps
