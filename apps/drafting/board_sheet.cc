#include "apps/drafting/board_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kMargin_mm = 12.0, kRuler_mm = 14.0, kGap_mm = 8.0;

struct Paper {
  const char* name;
  double width_mm, height_mm;
};
constexpr std::array<Paper, 3> kPapers = {
    {{"A4", 210.0, 297.0}, {"A3", 297.0, 420.0}, {"letter", 215.9, 279.4}}};

Eigen::Vector2d size_mm(const calib::CharucoBoard& board) {
  return {board.squares_x * board.square_mm, board.squares_y * board.square_mm};
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Of the mesh seen from above, closed: the convex hull (Andrew 1979), which is what a pencil around
// a convex piece draws.
Points outline_of(const TriangleMesh& mesh) {
  Points points;
  for (const Eigen::Vector3d& v : mesh.vertices_mm) points.emplace_back(v.head<2>());
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  Points hull;
  for (const bool forth : {true, false}) {
    const std::size_t first = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    std::reverse(points.begin(), points.end());
    if (forth) hull.pop_back();
  }
  return hull;
}

// Squares and the cells of markers, rows of equal colour joined.
void add_board(const calib::CharucoBoard& board, const Eigen::Vector2d& at_mm, Sheet& sheet) {
  const calib::CharucoPattern pattern(board);
  const auto add = [&](double x0, double y0, double x1, double y1) {
    sheet.black.push_back({at_mm + Eigen::Vector2d(x0, y0), at_mm + Eigen::Vector2d(x1, y1)});
  };
  const double cell = board.marker_mm / pattern.cells();
  const double inset = 0.5 * (board.square_mm - board.marker_mm);
  for (int j = 0; j < board.squares_y; ++j) {
    for (int i = 0; i < board.squares_x; ++i) {
      const double x = i * board.square_mm, y = j * board.square_mm;
      if (pattern.reflectance(x + 0.5 * inset, y + 0.5 * inset) == 0.0) {
        add(x, y, x + board.square_mm, y + board.square_mm);
        continue;
      }
      for (int row = 0; row < pattern.cells(); ++row) {
        const double low = y + inset + row * cell;
        int begin = -1;
        for (int c = 0; c <= pattern.cells(); ++c) {
          const bool black =
              c < pattern.cells() &&
              pattern.reflectance(x + inset + (c + 0.5) * cell, low + 0.5 * cell) == 0.0;
          if (black && begin < 0) begin = c;
          if (black || begin < 0) continue;
          add(x + inset + begin * cell, low, x + inset + c * cell, low + cell);
          begin = -1;
        }
      }
    }
  }
}

// Ticks at every mm, longer ones at 5 and 10.
void add_ruler(Sheet& sheet) {
  const int length_mm = 10 * static_cast<int>((sheet.width_mm - 2 * kMargin_mm) / 10.0);
  const double y = kMargin_mm;
  sheet.lines.push_back({{{kMargin_mm, y}, {kMargin_mm + length_mm, y}}, 0.1, false});
  for (int k = 0; k <= length_mm; ++k) {
    const double x = kMargin_mm + k;
    const double tick = k % 10 == 0 ? 4.0 : k % 5 == 0 ? 3.0 : 2.0;
    sheet.lines.push_back({{{x, y}, {x, y + tick}}, 0.1, false});
  }
  sheet.texts.push_back({{kMargin_mm, y + 6.0},
                         fmt::format("{} mm: print at 100 %, then measure this line", length_mm),
                         3.0});
}

const Paper& paper_of(const std::string& name) {
  const auto it =
      std::find_if(kPapers.begin(), kPapers.end(), [&](const Paper& p) { return name == p.name; });
  if (it != kPapers.end()) return *it;
  throw InputError("--paper",
                   fmt::format("must be one of {}, got {}", fmt::join(paper_names(), ", "), name));
}

}  // namespace

const std::vector<std::string>& paper_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Paper& p : kPapers) out.emplace_back(p.name);
    return out;
  }();
  return names;
}

Eigen::Vector3d board_beside(const calib::CharucoBoard& board, const Box3d& piece) {
  const Eigen::Vector2d size = size_mm(board);
  return {piece.center_mm().x() - 0.5 * size.x(), piece.min_mm.y() - kGap_mm - size.y(), 0.0};
}

BoardSheet board_sheet(const calib::CharucoBoard& board, const std::optional<TriangleMesh>& piece,
                       const std::string& paper) {
  if (const std::string problem = calib::board_problem(board); !problem.empty()) {
    throw InputError(problem.find("dictionary") == std::string::npos ? "--board" : "--dictionary",
                     problem);
  }
  const Paper& page = paper_of(paper);
  BoardSheet out;
  out.sheet.width_mm = page.width_mm;
  out.sheet.height_mm = page.height_mm;
  const Eigen::Vector2d board_size = size_mm(board);
  const Box3d box =
      piece ? bounds(*piece) : Box3d{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const double needed_mm = std::max(board_size.x(), box.size_mm().x()) + 2.0 * kMargin_mm;
  const double high_mm = 2.0 * kMargin_mm + kRuler_mm + board_size.y() +
                         (piece ? box.size_mm().y() + 2.0 * kGap_mm : kGap_mm);
  if (needed_mm > page.width_mm || high_mm > page.height_mm) {
    throw InputError("--paper",
                     fmt::format("{:.0f} x {:.0f} mm are needed, {} has {:.0f} x {:.0f} mm",
                                 needed_mm, high_mm, page.name, page.width_mm, page.height_mm));
  }
  out.board_mm = {0.5 * (page.width_mm - board_size.x()), kMargin_mm + kRuler_mm};
  add_board(board, out.board_mm, out.sheet);
  add_ruler(out.sheet);
  std::string text =
      fmt::format("ChArUco {}, {} x {} squares of {:g} mm, markers {:g} mm", board.dictionary,
                  board.squares_x, board.squares_y, board.square_mm, board.marker_mm);
  out.sheet.texts.push_back({{out.board_mm.x(), out.board_mm.y() - 4.0}, text, 3.0});
  if (!piece) return out;
  out.board_in_world_mm = board_beside(board, box);
  const Eigen::Vector2d origin = out.board_mm - out.board_in_world_mm->head<2>();
  // As far around as the piece is wide; towards the board, which needs a white border, less.
  const double around_mm = std::min(box.size_mm().head<2>().maxCoeff(),
                                    0.5 * (page.width_mm - box.size_mm().x()) - kMargin_mm);
  const Eigen::Vector2d low(around_mm, 0.6 * kGap_mm), high(around_mm, around_mm);
  out.sheet.black.push_back({origin + box.min_mm.head<2>() - low,
                             (origin + box.max_mm.head<2>() + high)
                                 .cwiseMin(Eigen::Vector2d(page.width_mm, page.height_mm))});
  SheetLine outline{{}, 0.2, true};
  for (const Eigen::Vector2d& p : outline_of(*piece)) outline.points_mm.push_back(origin + p);
  out.sheet.lines.push_back(std::move(outline));
  for (const Eigen::Vector2d& arm : {Eigen::Vector2d(2.0, 0.0), Eigen::Vector2d(0.0, 2.0)}) {
    out.sheet.lines.push_back({{origin - arm, origin + arm}, 0.1, true});
  }
  return out;
}

}  // namespace scattermeter::apps
