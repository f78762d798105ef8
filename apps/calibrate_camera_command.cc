#include <memory>
#include <ostream>

#include "apps/calibrate_camera.h"
#include "apps/calibrate_commands.h"
#include "core/input_error.h"

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

}  // namespace

void add_calibrate_camera(CLI::App& calibrate, CommandContext& context) {
  struct Options {
    std::string board, squares, corners;
    CalibrateCameraOptions run;
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
  command->add_option("--out", options->run.out, "file to write (YAML); pictures beside it")
      ->required();
  CLI::Option* rig =
      command->add_option("--rig", options->run.rig, "rig file (YAML) with calibration.camera");
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
      CalibrateCameraOptions& run_options = options->run;
      if (run_options.rig.empty()) {
        if (options->board.empty()) throw InputError("--board", "is missing (or --rig)");
        const bool by_squares = !options->squares.empty();
        if (!by_squares && options->corners.empty()) {
          throw InputError("--squares", "is missing (or --corners, or --rig)");
        }
        const auto [nx, ny] = by_squares ? read_counts("--squares", options->squares)
                                         : read_counts("--corners", options->corners);
        calib::CalibrationBoard& board_read = run_options.board;
        board_read.kind = options->board == "charuco" ? calib::BoardKind::kCharuco
                                                      : calib::BoardKind::kChessboard;
        board_read.squares_x = by_squares ? nx : nx + 1;
        board_read.squares_y = by_squares ? ny : ny + 1;
        if (const std::string problem = calib::calibration_board_problem(board_read);
            !problem.empty()) {
          throw InputError("the board's options", problem);
        }
      }
      run_options.command_line = context.command_line;
      const CameraCalibrationRun run = calibrate_camera_shots(run_options);
      if (!context.quiet) context.out << camera_calibration_table(run);
      if (run.calibration.status == calib::CameraCalibrationStatus::kOk) return 0;
      context.err << "scattermeter: refused, nothing is written: " << run.calibration.message
                  << "\n";
      return 1;
    };
  });
}

}  // namespace scattermeter::apps
