#include "apps/rig/rig_pose_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/rig/rig_fields.h"

namespace scattermeter::apps {
namespace {

calib::CharucoBoard read_board(const YamlField& field) {
  field.only({"squares", "square_mm", "marker_mm", "dictionary", "origin_mm", "x_axis", "y_axis"});
  calib::CharucoBoard board;
  const std::array<int, 2> squares = integer_pair(field.at("squares"), 2, 1000);
  board.squares_x = squares[0];
  board.squares_y = squares[1];
  board.square_mm = field.at("square_mm").positive();
  require_mm(field.at("square_mm"), board.square_mm, 0.1);
  board.marker_mm = field.at("marker_mm").positive();
  if (const auto f = field.find("dictionary")) board.dictionary = f->text();
  Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  if (const auto f = field.find("x_axis")) x = unit_vector(*f);
  if (const auto f = field.find("y_axis")) y = unit_vector(*f);
  Eigen::Matrix3d rotation;
  rotation << x, y, x.cross(y);
  if (std::abs(x.dot(y)) > 1e-6) field.fail("x_axis and y_axis are not at right angles");
  board.world_from_board.rotation = Eigen::Quaterniond(rotation).normalized();
  if (const auto f = field.find("origin_mm")) board.world_from_board.translation_mm = f->vector3();
  if (const std::string problem = calib::board_problem(board); !problem.empty()) {
    field.fail(problem);
  }
  return board;
}

}  // namespace

calib::PoseSource read_pose(const YamlField& field) {
  field.only({"points", "charuco", "shot", "inlier_px", "point_std_px", "refine", "edge_std_px",
              "per_shot"});
  calib::PoseSource pose;
  pose.line = field.line();
  const auto points = field.find("points");
  const auto charuco = field.find("charuco");
  if (points.has_value() == charuco.has_value()) field.fail("expected either points or charuco");
  if (points) {
    pose.line = points->line();
    double extent_mm = 0;
    for (const YamlField& pair : points->items()) {
      pair.only({"world_mm", "image_px"});
      const std::vector<double> px = pair.at("image_px").numbers(2);
      pose.points.push_back({pair.at("world_mm").vector3(), {px[0], px[1]}});
      extent_mm =
          std::max(extent_mm, (pose.points.back().world_mm - pose.points.front().world_mm).norm());
    }
    require_mm(*points, extent_mm, 2.0);
  } else {
    pose.line = charuco->line();
    pose.charuco = read_board(*charuco);
    pose.options.point_std_px = 0.15;  // the corners of boards scatter by 0.06 to 0.14 px
  }
  if (const auto f = field.find("inlier_px")) pose.options.inlier_px = f->positive();
  if (const auto f = field.find("point_std_px")) pose.options.point_std_px = f->positive();
  if (const auto f = field.find("refine")) {
    if (f->text() != "silhouette") f->fail("expected silhouette");
    pose.refine_by_silhouette = true;
  }
  if (const auto f = field.find("edge_std_px")) {
    if (!pose.refine_by_silhouette) f->fail("is allowed only with refine: silhouette");
    pose.edge_std_px = f->positive();
  }
  if (const auto f = field.find("shot")) {
    if (!charuco) f->fail("is the shot of a board, which needs charuco");
    pose.board_shot = file_in_folder(*f);
  }
  const bool in_each = charuco && pose.board_shot.empty();
  pose.per_shot = in_each;
  if (const auto f = field.find("per_shot")) {
    pose.per_shot = f->boolean();
    if (in_each && !pose.per_shot)
      f->fail("with a board in every shot, each shot has its own pose");
    if (!in_each && pose.per_shot && !pose.refine_by_silhouette) {
      f->fail("there is one pose for all shots; per_shot needs refine: silhouette");
    }
  }
  return pose;
}

}  // namespace scattermeter::apps
