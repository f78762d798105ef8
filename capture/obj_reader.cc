#include "capture/obj_reader.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <tiny_obj_loader.h>

#include "capture/obj_lines.h"
#include "capture/polygon_triangulation.h"
#include "core/input_error.h"

namespace scattermeter::capture {
namespace {

std::string read_text(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(path, "no such file");
  if (std::filesystem::is_directory(status)) {
    throw InputError(path, "is a folder, an OBJ file is expected");
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  // An empty file leaves the sink's fail bit set, which is why only the source is asked.
  if (!stream || ((text << stream.rdbuf()), stream.bad())) {
    throw InputError(path, "cannot be read");
  }
  return std::move(text).str();
}

// Collects what the parser calls back with. The library's own triangulation is not used: it keeps
// corner counts in a byte and cuts some concave quadrilaterals along the diagonal outside.
struct Collector {
  TriangleMesh mesh;
  std::vector<std::vector<int>> faces_vertex_idx;

  void face(const tinyobj::index_t* indices, int count) {
    std::vector<int> vertex_idx;
    const auto vertices = static_cast<int>(mesh.vertices_mm.size());
    for (int i = 0; i < count; ++i) {
      const int index = indices[i].vertex_index;
      vertex_idx.push_back(index > 0 ? index - 1 : vertices + index);
    }
    faces_vertex_idx.push_back(std::move(vertex_idx));
  }

  // After the last line: a face may name vertices that come later.
  void triangulate() {
    for (const std::vector<int>& vertex_idx : faces_vertex_idx) {
      std::vector<Eigen::Vector3d> corners_mm;
      corners_mm.reserve(vertex_idx.size());
      for (const int idx : vertex_idx) {
        corners_mm.push_back(mesh.vertices_mm.at(static_cast<std::size_t>(idx)));
      }
      for (const std::array<int, 3>& triangle : triangulate_polygon(corners_mm)) {
        const auto vertex = [&](int corner) {
          return vertex_idx[static_cast<std::size_t>(corner)];
        };
        mesh.triangles.push_back({vertex(triangle[0]), vertex(triangle[1]), vertex(triangle[2])});
      }
    }
  }
};

}  // namespace

TriangleMesh read_obj(const std::string& path, std::size_t max_triangles) {
  const ObjGeometry geometry = obj_geometry(path, read_text(path), max_triangles);
  if (geometry.faces == 0) throw InputError(path, "holds no faces");

  Collector collector;
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* user, double x, double y, double z, double /*w*/) {
    static_cast<Collector*>(user)->mesh.vertices_mm.emplace_back(x, y, z);
  };
  callbacks.index_cb = [](void* user, tinyobj::index_t* indices, int count) {
    static_cast<Collector*>(user)->face(indices, count);
  };
  std::istringstream stream(geometry.text);
  std::string warning;
  std::string error;
  const bool ok =
      tinyobj::LoadObjWithCallback(stream, callbacks, &collector, nullptr, &warning, &error);
  if (!ok || !error.empty()) throw InputError(path, "cannot be parsed: " + error);
  for (const Eigen::Vector3d& vertex_mm : collector.mesh.vertices_mm) {
    if (!vertex_mm.allFinite()) throw InputError(path, "a coordinate has too many digits");
  }
  collector.triangulate();
  if (collector.mesh.vertices_mm.size() != geometry.vertices ||
      collector.mesh.triangles.size() != geometry.triangles) {
    throw std::logic_error("read_obj: " + path + " was parsed to another number of elements");
  }
  return merge_equal_vertices(collector.mesh);
}

}  // namespace scattermeter::capture
