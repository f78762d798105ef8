// The geometry lines of a Wavefront OBJ text, checked one by one.
#pragma once

#include <cstddef>
#include <string>

namespace scattermeter::capture {

struct ObjGeometry {
  std::string text;           // the lines `v x y z` and `f i ...` alone, each ended by '\n'
  std::size_t vertices = 0;   // `v` lines
  std::size_t faces = 0;      // `f` lines
  std::size_t triangles = 0;  // that the faces will be cut into
};

// Stands before the parser, which takes any word for a number (as 0), wraps huge indices and skips
// lines that it does not know, so that a damaged file would be read as another shape.
// Line ends: \n, \r\n or \r; a comment may follow on any line.
// Throws InputError "file:line: ..." for
//  - a coordinate that is not a finite number, a vertex with other than 3 (4 with weight, 6 or 7
//    with colour) numbers,
//  - a face of fewer than three corners, a corner that is not i, i/j, i//k or i/j/k in integers, a
//    vertex index of 0 or out of range (negative ones count back from the last vertex so far),
//  - a keyword that the OBJ format does not have, a line continued with a backslash,
//  - more than `max_triangles`.
ObjGeometry obj_geometry(const std::string& path, const std::string& text,
                         std::size_t max_triangles);

}  // namespace scattermeter::capture
