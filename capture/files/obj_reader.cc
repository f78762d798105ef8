#include "capture/files/obj_reader.h"

#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <tiny_obj_loader.h>

#include "capture/files/file_text.h"
#include "capture/files/obj_syntax.h"
#include "capture/files/polygon_triangulation.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

// Receives the parser's callbacks. tinyobjloader's own triangulation is not used: it stores corner
// counts in a byte and cuts every quadrilateral along its shorter diagonal, which lies outside some
// concave ones.
struct Collector {
  TriangleMesh mesh;
  std::vector<std::vector<int>> faces_vertex_idx;

  void face(const tinyobj::index_t* indices, int count) {
    std::vector<int> vertex_idx;
    const auto vertices = static_cast<int>(mesh.vertices_mm.size());
    // The words of a comment behind the corners are parsed, too; its '#' has the index 0.
    for (int i = 0; i < count && indices[i].vertex_index != 0; ++i) {
      const int index = indices[i].vertex_index;
      vertex_idx.push_back(index > 0 ? index - 1 : vertices + index);
    }
    faces_vertex_idx.push_back(std::move(vertex_idx));
  }

  // Called after the last line, as a face may use vertices of later lines.
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
  std::istringstream stream(file_text(path, "an OBJ file is expected"));
  const ObjCounts counts = check_obj_syntax(path, stream.view(), max_triangles);
  if (counts.faces == 0) throw InputError(path, "contains no faces");

  Collector collector;
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* user, double x, double y, double z, double /*w*/) {
    static_cast<Collector*>(user)->mesh.vertices_mm.emplace_back(x, y, z);
  };
  callbacks.index_cb = [](void* user, tinyobj::index_t* indices, int count) {
    static_cast<Collector*>(user)->face(indices, count);
  };
  std::string error;
  const bool ok =
      tinyobj::LoadObjWithCallback(stream, callbacks, &collector, nullptr, nullptr, &error);
  if (!ok || !error.empty()) throw InputError(path, "cannot be parsed: " + error);
  for (const Eigen::Vector3d& vertex_mm : collector.mesh.vertices_mm) {
    if (!vertex_mm.allFinite()) throw InputError(path, "a coordinate has too many digits");
  }
  collector.triangulate();
  if (collector.mesh.vertices_mm.size() != counts.vertices ||
      collector.mesh.triangles.size() != counts.triangles) {
    throw std::logic_error("read_obj: " + path + " was parsed into another number of elements");
  }
  return merge_equal_vertices(collector.mesh);
}

}  // namespace scattermeter::capture
