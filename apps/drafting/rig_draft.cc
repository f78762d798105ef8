#include "apps/drafting/rig_draft.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "apps/drafting/board_sheet.h"
#include "apps/drafting/listed_numbers.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

// Of the width, a macro lens on a small sensor: placeholders only.
constexpr double kFocalLength = 2.5;

// A name that needs no quotes in YAML.
const std::string& checked_name(const std::string& name, const char* option) {
  const bool fits =
      !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
          std::string::npos;
  if (fits) return name;
  throw InputError(
      option, "must be a name of letters, digits, _ and -, beginning with a letter, got " + name);
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

std::string list(const Eigen::Vector3d& v) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x(), v.y(), v.z());
}

// Around the piece, in front and above, where shadow edges are in view.
Eigen::Vector3d placeholder_mm(std::size_t led) {
  constexpr std::array<double, 4> kAround_deg = {-130.0, -50.0, 160.0, 20.0};
  const double angle = kAround_deg[led % kAround_deg.size()] * std::numbers::pi / 180.0;
  return {std::round(70.0 * std::cos(angle)), std::round(70.0 * std::sin(angle)), 80.0};
}

class Writer {
 public:
  explicit Writer(const RigDraft& draft)
      : draft_(draft),
        board_(draft.board ? *draft.board : drafted_board(kUsualBoard)),
        board_in_world_mm_(board_beside(board_, draft.objects[0].box)) {}

  DraftedRig write() {
    if (!draft_.schema_path.empty()) {
      out_.yaml = "# yaml-language-server: $schema=" + draft_.schema_path + "\n";
    }
    out_.yaml +=
        "# Lines marked MEASURE hold placeholders: replace them by what your rig is, then run\n"
        "# `scattermeter check`. Every key is in apps/RIG.md; lengths are mm, world z is up.\n"
        "scattermeter_rig: 1\n";
    camera();
    pose();
    objects();
    lights();
    shots();
    if (draft_.is_example) truth();
    return std::move(out_);
  }

 private:
  void add(const std::string& line) { out_.yaml += line + "\n"; }
  std::string mark(const std::string& what) {
    if (draft_.is_example) return "";
    out_.to_measure.push_back(what);
    return "   # MEASURE: " + what;
  }

  void camera() {
    const ShotListing& l = draft_.listing;
    const double f_px = kFocalLength * l.width_px;
    add("\ncamera:");
    add("  model: " + quoted(l.model));
    add(fmt::format("  image_size_px: [{}, {}]", l.width_px, l.height_px));
    const std::string marked =
        mark("the lens, by `scattermeter calibrate camera`: then `intrinsics: camera.yaml`");
    add(
        fmt::format("  intrinsics: {{fx_px: {:.6g}, fy_px: {:.6g}, cx_px: {:.6g}, cy_px: {:.6g}, "
                    "distortion: [0, 0, 0, 0, 0]}}{}",
                    f_px, f_px, 0.5 * (l.width_px - 1), 0.5 * (l.height_px - 1), marked));
    if (draft_.is_example) {
      add("  responsivity_counts_mm2_sr_per_W_s: [2.4e10, 2.9e10, 2.1e10]");
      return;
    }
    add("  # Without a responsivity the scale is free, and sigma_a is determined less well.");
    add("  # `scattermeter calibrate radiance` measures it: then\n  # radiance: radiance.yaml");
  }

  void pose() {
    const std::string marked =
        mark(draft_.board ? "where the board's lower left corner lies in the world: origin_mm"
                          : "the ChArUco board in the shots (`scattermeter print` draws this one), "
                            "or pose.points");
    add("\npose:");
    add(
        fmt::format("  charuco: {{squares: [{}, {}], square_mm: {:.6g}, marker_mm: {:.6g}, "
                    "origin_mm: {}}}{}",
                    board_.squares_x, board_.squares_y, board_.square_mm, board_.marker_mm,
                    list(board_in_world_mm_), marked));
  }

  void objects() {
    add("\nobjects:");
    for (const DraftedObject& o : draft_.objects) {
      const std::string marked = mark(fmt::format(
          "eta of {}, and the position of {}: that of the piece relative to the board or, with "
          "`pose: {{from: silhouette, on_plane: true}}`, within about 5 mm of it",
          o.name, o.mesh));
      add(fmt::format("  {}: {{mesh: {}, eta: 1.49}}{}", checked_name(o.name, "--body"),
                      quoted(o.mesh), marked));
    }
  }

  void lights() {
    add("\nlights:");
    for (std::size_t i = 0; i < draft_.leds.size(); ++i) {
      const DraftedLed& led = draft_.leds[i];
      const Eigen::Vector3d at = led.position_mm.value_or(placeholder_mm(i));
      const std::string marked = mark(
          led.position_mm ? fmt::format("axis, exponent and intensity of {}", led.name)
                          : fmt::format("position, axis, exponent and intensity of {}", led.name));
      add(fmt::format("  {}: {{type: led, position_mm: {}, axis: {}, exponent: 1,", led.name,
                      list(at), list(Eigen::Vector3d(0, 0, 10) - at)));
      add(fmt::format("    intensity_W_per_sr: [0.050, 0.052, 0.047]}}{}", marked));
    }
  }

  void shots() {
    const std::vector<ListedShot>& shots = draft_.listing.shots;
    const std::size_t n_leds = draft_.leds.size();
    const std::string marked = mark("which object, material and LED each shot shows");
    add("\nshots:" + marked);
    for (std::size_t i = 0; i < shots.size(); ++i) {
      const ListedShot& s = shots[i];
      const DraftedObject& object = draft_.objects[i / n_leds % draft_.objects.size()];
      std::string line = fmt::format(
          "  - {{file: {}, object: {}, material: {}, lights: [{}]}}", quoted(s.file), object.name,
          checked_name(draft_.material, "--material"), draft_.leds[i % n_leds].name);
      if (s.exposure_s > 0.0) {
        line += fmt::format("   # {:.4g} s, ISO {:.0f}, f/{:.3g}", s.exposure_s, s.iso, s.f_number);
      }
      add(line);
    }
  }

  void truth() {
    add("\n# For `simulate` and `plan`.");
    add("truth:");
    // Board and piece fill the frame's height. A camera never stands exactly in line with them.
    const Box3d& box = draft_.objects[0].box;
    const double front_mm = board_in_world_mm_.y();
    const double extent_mm =
        std::max(board_.squares_x * board_.square_mm, box.max_mm.y() - front_mm);
    const Eigen::Vector3d at(box.center_mm().x(), 0.5 * (box.max_mm.y() + front_mm),
                             0.25 * box.max_mm.z());
    const Eigen::Vector3d from = at + extent_mm * Eigen::Vector3d(-0.2, -3.3, 2.4);
    add(fmt::format("  pose: {{position_mm: {}, look_at_mm: {}}}", list(from), list(at)));
    add("  materials:");
    add(
        fmt::format("    {}: {{sigma_s_prime_per_mm: [1.15, 1.32, 1.5], sigma_a_per_mm: [0.0016, "
                    "0.0013, 0.0026]}}",
                    draft_.material));
  }

  const RigDraft& draft_;
  calib::CharucoBoard board_;
  Eigen::Vector3d board_in_world_mm_;
  DraftedRig out_;
};

}  // namespace

DraftedLed drafted_led(const std::string& text) {
  const std::size_t colon = text.find(':');
  DraftedLed out{checked_name(text.substr(0, colon), "--led"), {}};
  if (colon == std::string::npos) return out;
  const std::vector<double> at =
      listed_numbers(std::string_view(text).substr(colon + 1), ',', "--led", text);
  if (at.size() != 3) {
    throw InputError("--led", "needs x,y,z in mm, as in left:-60,-80,120, got " + text);
  }
  out.position_mm = Eigen::Vector3d(at[0], at[1], at[2]);
  return out;
}

calib::CharucoBoard drafted_board(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::vector<double> squares =
      listed_numbers(std::string_view(text).substr(0, colon), 'x', "--board", text);
  const std::vector<double> sizes =
      colon == std::string::npos
          ? std::vector<double>{}
          : listed_numbers(std::string_view(text).substr(colon + 1), ':', "--board", text);
  const auto is_count = [](double n) { return n >= 2.0 && n <= 1000.0 && n == std::floor(n); };
  constexpr double kLeast_mm = 0.5;
  if (squares.size() != 2 || sizes.size() != 2 || !is_count(squares[0]) || !is_count(squares[1]) ||
      !(sizes[1] > 0.0)) {
    throw InputError(
        "--board",
        "needs squares, their size and that of the markers in mm, as in 10x7:6:4.5, got " + text);
  }
  if (!(sizes[1] < sizes[0])) {
    throw InputError("--board", "needs markers that are smaller than the squares, got " + text);
  }
  if (sizes[0] < kLeast_mm) {
    throw InputError("--board", "needs lengths in mm (squares of 0.5 mm or more), got " + text);
  }
  calib::CharucoBoard out;
  out.squares_x = static_cast<int>(squares[0]);
  out.squares_y = static_cast<int>(squares[1]);
  out.square_mm = sizes[0];
  out.marker_mm = sizes[1];
  return out;
}

ShotListing example_listing(const std::vector<DraftedLed>& leds) {
  ShotListing out{"NIKON D80", 3872, 2592, {}, {}};
  for (const DraftedLed& led : leds) out.shots.push_back({led.name + ".dng", 0, 0, 0});
  return out;
}

DraftedRig drafted_rig(const RigDraft& draft) { return Writer(draft).write(); }

}  // namespace scattermeter::apps
