// The words for what the outlines of the objects contradict.
#pragma once

#include <string>

#include "apps/looks/finding.h"
#include "calib/pose/outline_causes.h"
#include "calib/pose/pose_source.h"
#include "core/camera/camera_pose.h"

namespace scattermeter::apps {

// The next step for an object that is not of its mesh's size.
std::string advice_on_scale(const std::string& object);

// Distance of a camera whose pose is from a board (pose.charuco, pose.shot), which is known as well
// as the size of the board's squares; 0: its pose is from points.
double board_distance_mm(const calib::PoseSource& source, const PoseResult& pose);

// ", or the squares of the board are 2.1 % smaller than stated", for objects that are seen nearer
// than the board puts them by this share of their distance; "" where that is no explanation.
std::string or_of_another_board(double nearer);

// Of a diagnosis that does not agree: its most probable cause with those that cannot be told from
// it, and the next step; without shots. object: the one whose mesh is in question; "": none.
// distance_mm: as from board_distance_mm().
Finding outline_finding(const calib::OutlineDiagnosis& diagnosis, const std::string& object,
                        double distance_mm = 0.0);

}  // namespace scattermeter::apps
