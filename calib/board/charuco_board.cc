#include "calib/board/charuco_board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "calib/board/charuco_opencv.h"

namespace scattermeter::calib {
namespace {

namespace aruco = cv::aruco;

constexpr std::array<std::pair<const char*, aruco::PREDEFINED_DICTIONARY_NAME>, 21> kDictionaries =
    {{{"DICT_4X4_50", aruco::DICT_4X4_50},
      {"DICT_4X4_100", aruco::DICT_4X4_100},
      {"DICT_4X4_250", aruco::DICT_4X4_250},
      {"DICT_4X4_1000", aruco::DICT_4X4_1000},
      {"DICT_5X5_50", aruco::DICT_5X5_50},
      {"DICT_5X5_100", aruco::DICT_5X5_100},
      {"DICT_5X5_250", aruco::DICT_5X5_250},
      {"DICT_5X5_1000", aruco::DICT_5X5_1000},
      {"DICT_6X6_50", aruco::DICT_6X6_50},
      {"DICT_6X6_100", aruco::DICT_6X6_100},
      {"DICT_6X6_250", aruco::DICT_6X6_250},
      {"DICT_6X6_1000", aruco::DICT_6X6_1000},
      {"DICT_7X7_50", aruco::DICT_7X7_50},
      {"DICT_7X7_100", aruco::DICT_7X7_100},
      {"DICT_7X7_250", aruco::DICT_7X7_250},
      {"DICT_7X7_1000", aruco::DICT_7X7_1000},
      {"DICT_ARUCO_ORIGINAL", aruco::DICT_ARUCO_ORIGINAL},
      {"DICT_APRILTAG_16h5", aruco::DICT_APRILTAG_16h5},
      {"DICT_APRILTAG_25h9", aruco::DICT_APRILTAG_25h9},
      {"DICT_APRILTAG_36h10", aruco::DICT_APRILTAG_36h10},
      {"DICT_APRILTAG_36h11", aruco::DICT_APRILTAG_36h11}}};

// Null for an unknown name.
cv::Ptr<aruco::Dictionary> find_dictionary(const std::string& name) {
  for (const auto& [known, id] : kDictionaries) {
    if (name == known) return aruco::getPredefinedDictionary(id);
  }
  return nullptr;
}

bool positive(double value) { return std::isfinite(value) && value > 0; }

}  // namespace

std::string board_problem(const CharucoBoard& board) {
  std::ostringstream out;
  const cv::Ptr<aruco::Dictionary> dictionary = find_dictionary(board.dictionary);
  const Rigid3d& place = board.world_from_board;
  // The product is computed in long long, as sizes from a file may be anything.
  const long long markers = static_cast<long long>(board.squares_x) * board.squares_y / 2;
  if (board.squares_x < 3 || board.squares_y < 3) {
    out << "squares must be at least 3 x 3, got " << board.squares_x << " x " << board.squares_y;
  } else if (!positive(board.square_mm)) {
    out << "square_mm must be positive and finite, got " << board.square_mm;
  } else if (!positive(board.marker_mm) || board.marker_mm >= board.square_mm) {
    out << "marker_mm (" << board.marker_mm << ") must be positive and smaller than square_mm ("
        << board.square_mm << ")";
  } else if (dictionary == nullptr) {
    out << "unknown dictionary \"" << board.dictionary << "\", expected one like DICT_4X4_50";
  } else if (markers > dictionary->bytesList.rows) {
    out << "dictionary " << board.dictionary << " has " << dictionary->bytesList.rows
        << " markers, but " << board.squares_x << " x " << board.squares_y << " squares need "
        << markers;
  } else if (!place.translation_mm.allFinite() || !(std::abs(place.rotation.norm() - 1) < 1e-6)) {
    out << "world_from_board must be finite with a unit quaternion";
  }
  return out.str();
}

cv::Ptr<aruco::CharucoBoard> opencv_board(const CharucoBoard& board) {
  const std::string problem = board_problem(board);
  if (!problem.empty()) throw std::invalid_argument("ChArUco board: " + problem);
  return aruco::CharucoBoard::create(
      board.squares_x, board.squares_y, static_cast<float>(board.square_mm),
      static_cast<float>(board.marker_mm), find_dictionary(board.dictionary));
}

CharucoPattern::CharucoPattern(const CharucoBoard& board)
    : squares_x_(board.squares_x),
      squares_y_(board.squares_y),
      square_mm_(board.square_mm),
      marker_mm_(board.marker_mm),
      cells_(0) {
  const cv::Ptr<aruco::CharucoBoard> print = opencv_board(board);
  cells_ = print->dictionary->markerSize + 2;
  int next_id = 0;
  for (int row = 0; row < squares_y_; ++row) {
    for (int column = 0; column < squares_x_; ++column) {
      const bool black = (row + column) % 2 == 0;
      marker_id_.push_back(black ? -1 : next_id++);
    }
  }
  for (int id = 0; id < next_id; ++id) {
    cv::Mat picture;  // one pixel per cell
    aruco::drawMarker(print->dictionary, id, cells_, picture, 1);
    std::transform(picture.begin<unsigned char>(), picture.end<unsigned char>(),
                   std::back_inserter(bit_),
                   [](unsigned char v) -> unsigned char { return v > 127 ? 1 : 0; });
  }
}

double CharucoPattern::reflectance(double x_mm, double y_mm) const {
  const double across = x_mm / square_mm_;             // squares from the left
  const double down = squares_y_ - y_mm / square_mm_;  // squares from the top
  if (!(across >= 0 && across <= squares_x_ && down >= 0 && down <= squares_y_)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const int column = std::min(static_cast<int>(across), squares_x_ - 1);
  const int row = std::min(static_cast<int>(down), squares_y_ - 1);
  const auto at = [](int line, int width, int place) {
    return static_cast<size_t>(line) * static_cast<size_t>(width) + static_cast<size_t>(place);
  };
  const int id = marker_id_[at(row, squares_x_, column)];
  if (id < 0) return 0;
  // The marker lies in the middle of its white square.
  const double margin = 0.5 * (1 - marker_mm_ / square_mm_);
  const double cells_per_square = cells_ * square_mm_ / marker_mm_;
  const double cell_x = std::floor((across - column - margin) * cells_per_square);
  const double cell_y = std::floor((down - row - margin) * cells_per_square);
  if (cell_x < 0 || cell_x >= cells_ || cell_y < 0 || cell_y >= cells_) return 1;
  const size_t cell = at(static_cast<int>(cell_y), cells_, static_cast<int>(cell_x));
  return bit_[at(id, cells_ * cells_, 0) + cell];
}

}  // namespace scattermeter::calib
