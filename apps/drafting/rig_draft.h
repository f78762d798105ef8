// The text of a rig file to begin with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/drafting/shot_listing.h"
#include "calib/board/charuco_board.h"
#include "core/mesh/triangle_mesh.h"

namespace scattermeter::apps {

struct DraftedObject {
  std::string name;
  std::string mesh;  // file, relative to the rig
  Box3d box;         // of the mesh, mm
};

struct DraftedLed {
  std::string name;
  std::optional<Eigen::Vector3d> position_mm;  // absent: a placeholder
};

// "left:-60,-80,120" or "left". Throws InputError naming --led.
DraftedLed drafted_led(const std::string& text);

// A board that an A4 sheet holds beside a piece.
inline constexpr const char* kUsualBoard = "10x7:6:4.5";
// "10x7:6:4.5": squares, mm of a square, mm of a marker. Throws InputError naming --board.
calib::CharucoBoard drafted_board(const std::string& text);

struct RigDraft {
  ShotListing listing;
  std::vector<DraftedObject> objects;  // at least one
  std::string material = "material";
  std::vector<DraftedLed> leds;              // at least one
  std::optional<calib::CharucoBoard> board;  // absent: kUsualBoard, a placeholder
  // A rig that can be simulated at once: with a responsivity and a truth.
  bool is_example = false;
  std::string schema_path;  // of rig.schema.json, which editors read; "": not named
};

// The listing of an example: a D80, one shot under each LED.
ShotListing example_listing(const std::vector<DraftedLed>& leds);

struct DraftedRig {
  std::string yaml;                     // a valid rig file
  std::vector<std::string> to_measure;  // what in it is a placeholder, a phrase each
};

// Shots are given to objects and LEDs in turn, in the order of their names. Throws InputError for
// names that a rig cannot have.
DraftedRig drafted_rig(const RigDraft& draft);

}  // namespace scattermeter::apps
