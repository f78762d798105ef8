// The table of arrows and doors: which folder may include which, and which files may name each
// foreign library. It fails when an include breaks the table, or when a folder grows past its
// purpose.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SCATTERMETER_SOURCE_DIR;

// Data goes up, includes go down: a folder may include itself and those above it in this list,
// except where kNever says otherwise.
const std::vector<std::string> kFolders = {
    "core/base",      "core/camera",     "core/material",
    "core/mesh",      "core/light",      "core/view",
    "core/sums",      "core/diffusion",  "core/transport",
    "core/fit",       "core/agreement",  "core/scene",
    "core/nuisances", "core/atlas",      "core/estimation",
    "capture/files",  "capture/raw",     "capture/sensor",
    "capture/shots",  "calib/board",     "calib/pose",
    "calib/lens",     "calib/led",       "calib/radiance",
    "apps/rig",       "apps/looks",      "apps/instrument",
    "apps/results",   "apps/drafting",   "apps/simulation",
    "apps/checking",  "apps/planning",   "apps/watching",
    "apps/report",    "apps/pages",      "apps/export",
    "apps/commands",  "apps/deviations", "apps/bench_transport",
    "apps/bench",     "apps/program",
};
// Arrows that the order allows and the purpose of the folders forbids.
const std::vector<std::pair<std::string, std::string>> kNever = {
    {"apps/report", "apps/export"},
    {"apps/pages", "apps/export"},
    {"apps/checking", "apps/simulation"},
    {"apps/program", "apps/bench"},
};
// Files that stand in a folder of these and may be named by nobody else.
const std::map<std::string, std::string> kOnlyFor = {{"apps/bench/", "apps/bench"},
                                                     {"apps/program/", "apps/program"}};

struct SourceFile {
  std::string folder;  // "core/light"
  std::string path;    // "core/light/led.cc"
};

struct Include {
  SourceFile from;
  std::string what;
  bool quoted;
};

std::vector<SourceFile> source_files() {
  std::vector<SourceFile> out;
  for (const std::string library : {"core", "capture", "calib", "apps"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / library)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cc") continue;
      const fs::path relative = fs::relative(entry.path(), kRoot);
      out.push_back({relative.parent_path().string(), relative.string()});
    }
  }
  return out;
}

std::vector<Include> includes() {
  std::vector<Include> out;
  const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
  for (const SourceFile& file : source_files()) {
    std::ifstream in(kRoot / file.path);
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (std::regex_search(line, match, pattern)) {
        out.push_back({file, match[2], match[1] == "\""});
      }
    }
  }
  return out;
}

// Every file and include below the four libraries is seen: raise the numbers as they grow.
TEST(Layering, ReadsEveryFile) {
  EXPECT_GT(source_files().size(), 550U);
  EXPECT_GT(includes().size(), 3500U);
}

TEST(Layering, FoldersIncludeOnlyWhatIsBelowThem) {
  const auto rank = [](const std::string& folder) {
    return std::find(kFolders.begin(), kFolders.end(), folder) - kFolders.begin();
  };
  for (const Include& i : includes()) {
    if (!i.quoted || i.from.folder == "apps/python") continue;
    const std::string target = i.what.substr(0, i.what.rfind('/'));
    ASSERT_LT(rank(i.from.folder), static_cast<std::ptrdiff_t>(kFolders.size())) << i.from.path;
    ASSERT_LT(rank(target), static_cast<std::ptrdiff_t>(kFolders.size()))
        << i.from.path << " includes " << i.what;
    EXPECT_LE(rank(target), rank(i.from.folder)) << i.from.path << " includes " << i.what;
    for (const auto& [from, to] : kNever) {
      EXPECT_FALSE(i.from.folder == from && target == to) << i.from.path << " includes " << i.what;
    }
    for (const auto& [prefix, folder] : kOnlyFor) {
      EXPECT_FALSE(i.what.starts_with(prefix) && i.from.folder != folder)
          << i.from.path << " includes " << i.what;
    }
    const bool calibrates = i.from.folder.starts_with("capture/");
    EXPECT_FALSE(calibrates && target.starts_with("calib/")) << i.from.path;
  }
}

// Beginning of a foreign include -> the only files that may hold it.
TEST(Layering, EachForeignLibraryHasItsDoor) {
  const std::vector<std::pair<std::string, std::set<std::string>>> doors = {
      {"libraw/", {"capture/raw/raw_reader.cc"}},
      {"tiff", {"capture/raw/tiff_output.h"}},
      {"tiny_obj_loader", {"capture/files/obj_reader.cc"}},
      {"OpenEXR/", {"capture/files/exr_file.cc"}},
      {"opencv2/",
       {"calib/board/board_detection.cc", "calib/board/charuco_detection.cc",
        "calib/board/charuco_opencv.h", "calib/board/grey_picture.cc",
        "calib/board/opencv_quiet.cc", "calib/board/opencv_storage.h", "calib/board/tone_picture.h",
        "calib/pose/pose_search.cc", "calib/lens/camera_start.cc", "calib/lens/view_selection.cc",
        "apps/report/overlay_picture.cc", "apps/report/picture.cc"}},
      {"cairo", {"apps/report/sheet_file.cc"}},
      {"embree", {"core/mesh/ray_scene.cc"}},
      {"hwy/",
       {"core/sums/cluster_verdicts.cc", "core/sums/dipole_kernels.cc",
        "core/sums/moment_kernels.cc", "core/sums/pair_kernels.cc", "core/sums/series_kernels.cc"}},
      {"ceres/",
       {"core/fit/dipole_solver.cc", "calib/pose/edge_fit.cc", "calib/lens/camera_bundle.cc",
        "calib/led/led_solver.cc"}},
      {"yaml-cpp/",
       {"apps/rig/yaml_field.h", "apps/rig/yaml_field.cc", "apps/rig/led_calibration_file.cc",
        "apps/rig/radiance_file.cc"}},
      {"nlohmann/",
       {"capture/shots/decoded_shot.cc", "apps/results/result_json.cc",
        "apps/results/result_reader.cc", "apps/report/check_json.cc", "apps/report/plan_json.cc",
        "apps/pages/page_plots.cc", "apps/pages/residual_maps.cc", "apps/pages/rig_figure.cc"}},
      {"CLI/", {"apps/commands/commands.h"}},
      {"mpi.h", {"apps/program/ranks.cc"}},
      {"zlib.h", {"apps/pages/packed_integers.cc"}},
      {"png.h", {"capture/files/png.cc"}},
      {"openssl/", {"capture/files/digest.cc", "apps/pages/base64.cc"}},
      {"pybind11/",
       {"apps/python/array_light.cc", "apps/python/array_light.h", "apps/python/binding.cc",
        "apps/python/bindings.h", "apps/python/dict_field.h", "apps/python/estimate_arrays.cc",
        "apps/python/models.cc", "apps/python/python_progress.cc",
        "apps/python/python_progress.h"}},
  };
  std::set<std::string> met;
  for (const Include& i : includes()) {
    if (i.quoted) continue;
    // The standard library's and the system's headers have no slash and no .h, or are POSIX's.
    static const std::regex standard(
        "[a-z_0-9]+|malloc\\.h|unistd\\.h|fcntl\\.h|spawn\\.h|sys/[a-z]+\\.h");
    if (std::regex_match(i.what, standard)) continue;
    // Eigen stands everywhere; fmt and TBB in any source, but in no header.
    if (i.what.starts_with("Eigen/")) continue;
    if (i.what == "unsupported/Eigen/SpecialFunctions") {
      EXPECT_EQ(i.from.path, "core/base/chi_square.cc");
      continue;
    }
    if (i.what.starts_with("fmt/") || i.what.starts_with("oneapi/tbb/") ||
        i.what.starts_with("tbb/")) {
      EXPECT_TRUE(i.from.path.ends_with(".cc")) << i.from.path << " includes <" << i.what << ">";
      continue;
    }
    const auto door = std::find_if(doors.begin(), doors.end(),
                                   [&](const auto& d) { return i.what.starts_with(d.first); });
    ASSERT_NE(door, doors.end()) << i.from.path << " includes <" << i.what
                                 << ">, which has no door";
    met.insert(door->first);
    EXPECT_TRUE(door->second.contains(i.from.path))
        << i.from.path << " includes <" << i.what << ">";
  }
  EXPECT_EQ(met.size(), doors.size()) << "a door that nobody uses";
}

TEST(Layering, CoreHeadersNeedOnlyStdAndEigen) {
  for (const Include& i : includes()) {
    if (!i.from.path.starts_with("core/") || !i.from.path.ends_with(".h") || i.quoted) continue;
    EXPECT_TRUE(i.what.starts_with("Eigen/") || i.what.find_first_of("/.") == std::string::npos)
        << i.from.path << " includes <" << i.what << ">";
  }
}

// Below a library's own folder stand only its build file and documents; no folder holds more
// modules than a reader can keep in mind.
TEST(Layering, FoldersHoldWhatTheyShould) {
  std::map<std::string, std::set<std::string>> modules;
  for (const SourceFile& file : source_files()) {
    EXPECT_NE(file.folder.find('/'), std::string::npos) << file.path << " stands in no room";
    modules[file.folder].insert(fs::path(file.path).stem().string());
  }
  for (const auto& [folder, names] : modules) EXPECT_LE(names.size(), 30U) << folder;
}

TEST(Layering, TopLevelHoldsWhatItShould) {
  const std::set<std::string> known = {"CMakeLists.txt",
                                       "CMakePresets.json",
                                       "README.md",
                                       "ACCURACY.md",
                                       "CHANGELOG.md",
                                       "CONTRIBUTING.md",
                                       "LICENSE",
                                       ".clang-format",
                                       ".clang-tidy",
                                       ".gitignore",
                                       ".ci",
                                       ".git",
                                       "capture",
                                       "calib",
                                       "core",
                                       "apps",
                                       "tests",
                                       "samples",
                                       "build"};
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    EXPECT_TRUE(known.contains(entry.path().filename().string())) << entry.path();
  }
}

// Sources that have no test of their name: tests of other modules run them. The list may only
// shrink. Commands and bench are run end to end: each command by tests of what it does (tests/apps,
// tests/calib and tests/road) and, with main, by the scripts in tests/road, which start the
// program.
const std::set<std::string>& tested_by_the_road() {
  static const std::set<std::string> names = {
      "apps/bench/bench_atlas_command",
      "apps/bench/bench_materials_command",
      "apps/bench/bench_models_report",
      "apps/bench/bench_noise_command",
      "apps/bench/bench_paper_report",
      "apps/bench/bench_patches_command",
      "apps/bench/bench_rig_command",
      "apps/bench/bench_shots_command",
      "apps/bench/bench_sums_command",
      "apps/bench/bench_sums_peer",
      "apps/bench/bench_sums_report",
      "apps/bench/bench_transport_command",
      "apps/commands/calibrate_camera_command",
      "apps/commands/calibrate_led_command",
      "apps/commands/calibrate_radiance_command",
      "apps/commands/render_command",
      "apps/program/main",
      "apps/program/ranks",
  };
  return names;
}

// Every other source has a test of its name, in the same folder below tests/. Those of apps/python
// are tested from Python.
TEST(Layering, TestsMirrorTheTree) {
  for (const SourceFile& file : source_files()) {
    if (!file.path.ends_with(".cc") || file.folder == "apps/python") continue;
    const std::string module = file.path.substr(0, file.path.size() - 3);
    const bool has_test = fs::exists(kRoot / "tests" / (module + "_test.cc"));
    EXPECT_NE(has_test, tested_by_the_road().contains(module))
        << module << (has_test ? " has a test: take it from the list" : " has no test");
  }
  for (const std::string& module : tested_by_the_road()) {
    EXPECT_TRUE(fs::exists(kRoot / (module + ".cc"))) << module << " is in the list, but gone";
  }
}

}  // namespace
