#include "apps/pages/rig_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/pages/page_number.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostCameras = 24;

void append(const Eigen::Vector3d& v, Json& list) {
  for (const double x : v) list.push_back(page_number(x));
}

Json coordinates(const Eigen::Vector3d& v) {
  Json out = Json::array();
  append(v, out);
  return out;
}

Json body_data(const RigPlaces::Body& body) {
  const TriangleMesh mesh = drawable_mesh(body.mesh);
  Json vertices = Json::array(), triangles = Json::array();
  for (const Eigen::Vector3d& v : mesh.vertices_mm) append(v, vertices);
  for (const auto& t : mesh.triangles) {
    for (const int vertex : t) triangles.push_back(vertex);
  }
  return {{"name", plain_text(body.name)}, {"vertices", vertices}, {"triangles", triangles}};
}

std::string place_text(const Eigen::Vector3d& v) {
  // Adding 0 turns -0 into 0.
  const Eigen::Array3d tenths = (10.0 * v.array()).round() / 10.0 + 0.0;
  return fmt::format("{:.1f}, {:.1f}, {:.1f}", tenths.x(), tenths.y(), tenths.z());
}

// The middles of the cells' vertices; triangles that shrink to lines are dropped.
TriangleMesh merged_in_cells(const TriangleMesh& mesh, double cell_mm) {
  const Eigen::Vector3d low = bounds(mesh).min_mm;
  std::map<std::array<int, 3>, int> cell_idx;
  std::vector<int> cell_of, count;
  TriangleMesh out;
  for (const Eigen::Vector3d& v : mesh.vertices_mm) {
    const Eigen::Vector3d at = (v - low) / cell_mm;
    const std::array<int, 3> cell = {static_cast<int>(at.x()), static_cast<int>(at.y()),
                                     static_cast<int>(at.z())};
    const auto [found, is_new] = cell_idx.try_emplace(cell, static_cast<int>(count.size()));
    if (is_new) {
      out.vertices_mm.emplace_back(Eigen::Vector3d::Zero());
      count.push_back(0);
    }
    cell_of.push_back(found->second);
    out.vertices_mm[static_cast<std::size_t>(found->second)] += v;
    ++count[static_cast<std::size_t>(found->second)];
  }
  for (std::size_t i = 0; i < count.size(); ++i) out.vertices_mm[i] /= count[i];
  std::set<std::array<int, 3>> known;
  for (const auto& t : mesh.triangles) {
    std::array<int, 3> merged;
    for (std::size_t k = 0; k < 3; ++k) merged[k] = cell_of[static_cast<std::size_t>(t[k])];
    if (merged[0] == merged[1] || merged[1] == merged[2] || merged[2] == merged[0]) continue;
    std::rotate(merged.begin(), std::min_element(merged.begin(), merged.end()), merged.end());
    if (known.insert(merged).second) out.triangles.push_back(merged);
  }
  return out;
}

}  // namespace

TriangleMesh drawable_mesh(const TriangleMesh& mesh, std::size_t most) {
  if (mesh.triangles.size() > most) {
    double cell_mm = bounds(mesh).size_mm().maxCoeff() / 64.0;
    TriangleMesh out = merged_in_cells(mesh, cell_mm);
    while (out.triangles.size() > most) out = merged_in_cells(mesh, cell_mm *= 1.25);
    return out;
  }
  int levels = 0;
  while ((mesh.triangles.size() << (2 * (levels + 1))) <= most / 3) ++levels;
  return merge_equal_vertices(cut_finer(mesh, levels));
}

std::string rig_data(const RigPlaces& places) {
  Json out = {{"cameras", Json::array()}, {"leds", Json::array()},  {"bodies", Json::array()},
              {"marks", Json::array()},   {"board", Json::array()}, {"plane_z", nullptr}};
  for (std::size_t i = 0; i < std::min(places.cameras.size(), kMostCameras); ++i) {
    const RigPlaces::Camera& c = places.cameras[i];
    Json corners = Json::array();
    for (const Eigen::Vector3d& d : c.corners) corners.push_back(coordinates(d));
    out["cameras"].push_back(
        {{"name", plain_text(c.name)}, {"at", coordinates(c.center_mm)}, {"corners", corners}});
  }
  for (const RigPlaces::Led& led : places.leds) {
    out["leds"].push_back({{"name", plain_text(led.name)},
                           {"at", coordinates(led.position_mm)},
                           {"axis", coordinates(led.axis)}});
  }
  for (const RigPlaces::Body& body : places.bodies) out["bodies"].push_back(body_data(body));
  for (const Eigen::Vector3d& mark : places.marks) out["marks"].push_back(coordinates(mark));
  if (places.board) {
    for (const Eigen::Vector3d& corner : *places.board) out["board"].push_back(coordinates(corner));
  }
  if (places.plane_z_mm) out["plane_z"] = page_number(*places.plane_z_mm);
  return out.dump();
}

Html rig_figure(const RigPlaces& places) {
  HtmlTable table;
  table.header = {"what", "x, y, z [mm]", "known to [mm]", "remark"};
  const auto add = [&](const std::string& what, const Eigen::Vector3d& at, double std_mm,
                       const std::string& remark) {
    table.rows.push_back({text_cell(what), number_cell(place_text(at)),
                          number_cell(std_mm > 0.0 ? fmt::format("{:.2g}", std_mm) : "–"),
                          text_cell(remark)});
  };
  for (const RigPlaces::Camera& c : places.cameras) {
    const Eigen::Vector3d ahead = (c.corners[0] + c.corners[2]).normalized();
    add(c.name, c.center_mm, c.center_std_mm.maxCoeff(), "looks along " + place_text(ahead));
  }
  for (const RigPlaces::Led& led : places.leds) {
    add(led.name, led.position_mm, led.position_std_mm, "axis " + place_text(led.axis));
  }
  for (const RigPlaces::Body& body : places.bodies) {
    const Box3d box = bounds(body.mesh);
    add(body.name, box.center_mm(), 0.0,
        "centre; extends over " + place_text(box.size_mm()) + " mm");
  }
  if (places.board) {
    add("board", (places.board->at(0) + places.board->at(2)) / 2.0, 0.0, "centre");
  }
  for (std::size_t i = 0; i < places.marks.size(); ++i) {
    add(fmt::format("mark {}", i + 1), places.marks[i], 0.0, "");
  }
  Html out = html_widget(
      "rig", rig_data(places),
      html_text("The rig as it was used: camera with its field of view, LEDs with their axes, the "
                "object, and the marks or the board that give the pose. Lengths in mm, z up."));
  out += html_details("positions", html_table(table));
  return out;
}

}  // namespace scattermeter::apps
