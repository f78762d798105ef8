#include <memory>
#include <ostream>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/drafting/board_sheet.h"
#include "apps/drafting/drafted_body.h"
#include "apps/drafting/rig_draft.h"
#include "apps/report/sheet_file.h"

namespace scattermeter::apps {
namespace {

struct PrintArguments {
  std::string out = "board.pdf", board = kUsualBoard, dictionary = "DICT_4X4_50", paper = "A4",
              body;
};

int run_print(const PrintArguments& a, CommandContext& context) {
  capture::require_output_file(a.out);
  calib::CharucoBoard board = drafted_board(a.board);
  board.dictionary = a.dictionary;
  std::optional<TriangleMesh> piece;
  if (!a.body.empty()) piece = drafted_body(a.body).mesh;
  const BoardSheet sheet = board_sheet(board, piece, a.paper);
  write_sheet(a.out, sheet.sheet);
  if (context.quiet) return 0;
  context.out << "written: " << a.out
              << "\nprint it at 100 % and measure its ruler; for the rig:\n";
  std::string line = fmt::format(
      "  charuco: {{squares: [{}, {}], square_mm: {:g}, marker_mm: {:g}, dictionary: {}",
      board.squares_x, board.squares_y, board.square_mm, board.marker_mm, board.dictionary);
  if (const auto& at = sheet.board_in_world_mm) {
    line += fmt::format(", origin_mm: [{:.6g}, {:.6g}, 0]", at->x(), at->y());
  }
  context.out << "pose:\n" << line << "}\n";
  return 0;
}

}  // namespace

void add_print_command(CLI::App& app, CommandContext& context) {
  const auto a = std::make_shared<PrintArguments>();
  CLI::App* command = app.add_subcommand(
      "print",
      "Draw a ChArUco board to be printed, true to scale, with a ruler.\n"
      "With --body, the outline of the piece stands beside the board at a known position: a piece "
      "put down on it stands in the board's frame as its mesh does in the rig. Prints the lines "
      "that the rig needs.");
  command->add_option("--out", a->out, "file to write, .pdf or .png (600 dots per inch)")
      ->capture_default_str();
  command->add_option("--board", a->board, "squares, mm of a square and of a marker: 10x7:6:4.5")
      ->capture_default_str();
  command->add_option("--dictionary", a->dictionary, "OpenCV's name of the markers")
      ->capture_default_str();
  command->add_option("--body", a->body,
                      "piece: as for `init`, cube:20 ..., or a mesh (.obj); default: none");
  command->add_option("--paper", a->paper, "size of the paper")
      ->check(CLI::IsMember(paper_names()))
      ->capture_default_str();
  run_if_named(*command, context, [a, &context] { return run_print(*a, context); });
}

}  // namespace scattermeter::apps
