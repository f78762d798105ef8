// The table of layers and doors: which folder may include which, and where each foreign library may
// be named. Fails when an include breaks it, or when the top level grows.
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

struct Include {
  std::string file;  // relative to the root
  std::string what;
  bool quoted;
};

std::vector<Include> includes_of(const std::string& folder) {
  std::vector<Include> out;
  const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
  for (const auto& entry : fs::directory_iterator(kRoot / folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cc") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (std::regex_search(line, match, pattern)) {
        out.push_back(
            {folder + "/" + entry.path().filename().string(), match[2], match[1] == "\""});
      }
    }
  }
  return out;
}

const std::vector<std::string> kFolders = {"core", "capture", "calib", "apps"};

TEST(Layering, FoldersIncludeOnlyWhatIsBelowThem) {
  const std::map<std::string, std::set<std::string>> allowed = {
      {"core", {"core"}},
      {"capture", {"capture", "core"}},
      {"calib", {"calib", "core"}},
      {"apps", {"apps", "calib", "capture", "core"}}};
  for (const std::string& folder : kFolders) {
    const std::vector<Include> includes = includes_of(folder);
    EXPECT_GT(includes.size(), 10U) << folder;
    for (const Include& i : includes) {
      if (!i.quoted) continue;
      const std::string target = i.what.substr(0, i.what.find('/'));
      EXPECT_TRUE(allowed.at(folder).contains(target)) << i.file << " includes " << i.what;
    }
  }
}

// Beginning of a foreign include -> the only files that may hold it.
TEST(Layering, EachForeignLibraryHasItsDoor) {
  const std::vector<std::pair<std::string, std::string>> doors = {
      {"libraw/", "capture/raw_reader\\.cc"},
      {"tiff", "capture/dng_writer\\.cc"},
      {"tiny_obj_loader", "capture/obj_reader\\.cc"},
      {"OpenEXR/", "capture/exr_file\\.cc"},
      {"opencv2/",
       "calib/[a-z_]+\\.cc|calib/(charuco_opencv|opencv_storage|tone_picture)\\.h|"
       "apps/(overlay_picture|picture|grey_picture)\\.cc"},
      {"embree", "core/ray_scene\\.cc"},
      {"hwy/", "core/(dipole_kernels|cluster_verdicts)\\.cc"},
      {"ceres/", "core/dipole_solver\\.cc|calib/[a-z_]+\\.cc"},
      {"yaml-cpp/", "apps/(yaml_field\\.(h|cc)|[a-z]+_calibration_file\\.cc)"},
      {"nlohmann/", "apps/((check|plan|result)_json|decoded_shot|result_reader)\\.cc"},
      {"CLI/", "apps/commands\\.h"},
      {"mpi.h", "apps/ranks\\.cc"},
      {"png.h", "apps/png\\.cc"},
      {"openssl/", "apps/(base64|digest)\\.cc"},
      {"fmt/", "apps/[a-z_]+\\.cc"},
      {"pybind11/", "apps/python/models\\.cc"},
      {"tbb/", "(apps|calib|capture|core)/[a-z0-9_]+\\.cc"},
      {"Eigen/", ".*"},
      {"unsupported/Eigen/", "core/chi_square\\.cc"},
  };
  std::set<std::string> met;
  std::vector<std::string> folders = kFolders;
  folders.emplace_back("apps/python");
  for (const std::string& folder : folders) {
    for (const Include& i : includes_of(folder)) {
      if (i.quoted) continue;
      // The standard library's and the system's headers have no slash and no .h, or are POSIX's.
      static const std::regex standard(
          "[a-z_0-9]+|unistd\\.h|dlfcn\\.h|fcntl\\.h|spawn\\.h|sys/[a-z]+\\.h");
      if (std::regex_match(i.what, standard)) continue;
      const auto door = std::find_if(doors.begin(), doors.end(), [&](const auto& d) {
        return i.what.starts_with(d.first) || i.what.starts_with("oneapi/" + d.first);
      });
      ASSERT_NE(door, doors.end()) << i.file << " includes <" << i.what << ">, which has no door";
      met.insert(door->first);
      EXPECT_TRUE(std::regex_match(i.file, std::regex(door->second)))
          << i.file << " includes <" << i.what << ">";
    }
  }
  EXPECT_EQ(met.size(), doors.size()) << "a door that nobody uses";
}

TEST(Layering, CoreHeadersNeedOnlyStdAndEigen) {
  for (const Include& i : includes_of("core")) {
    if (!i.file.ends_with(".h") || i.quoted) continue;
    EXPECT_TRUE(i.what.starts_with("Eigen/") || i.what.find_first_of("/.") == std::string::npos)
        << i.file << " includes <" << i.what << ">";
  }
}

TEST(Layering, TopLevelHoldsWhatItShould) {
  const std::set<std::string> known = {"CMakeLists.txt",
                                       "CMakePresets.json",
                                       "README.md",
                                       "CHANGELOG.md",
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

// Every source has a test of its name.
TEST(Layering, TestsMirrorTheTree) {
  for (const std::string folder : {"core", "capture", "calib"}) {
    for (const auto& entry : fs::directory_iterator(kRoot / folder)) {
      if (entry.path().extension() != ".cc") continue;
      const fs::path test = kRoot / "tests" / folder / (entry.path().stem().string() + "_test.cc");
      EXPECT_TRUE(fs::exists(test)) << folder << "/" << entry.path().filename() << " has no test";
    }
  }
}

}  // namespace
