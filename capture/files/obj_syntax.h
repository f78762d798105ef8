// Syntax check of Wavefront OBJ files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scattermeter::capture {

// What a parser must find in a file that passed the check.
struct ObjCounts {
  std::size_t vertices = 0;   // `v` lines
  std::size_t faces = 0;      // `f` lines
  std::size_t triangles = 0;  // after triangulation of the faces
};

// tinyobjloader reports no errors in text: a word that is not a number becomes 0, an index beyond
// an int wraps around, unknown lines are skipped. A damaged file would be read as another shape, so
// the text is checked here before it is parsed there.
// Line ends: \n, \r\n or \r. A comment begins with a word whose first character is '#'.
// Throws InputError "path:line: ..." for
//  - a coordinate that is not a finite number, a vertex with other than 3 numbers (4 with a weight,
//    6 or 7 with a colour),
//  - a face of fewer than three corners, a corner that is not i, i/j, i//k or i/j/k in integers, a
//    vertex index of 0 or out of range (negative indices count back from the last vertex so far),
//  - a keyword that the OBJ format does not have, a line continued with a backslash,
//  - more than `max_triangles`.
ObjCounts check_obj_syntax(const std::string& path, std::string_view text,
                           std::size_t max_triangles);

}  // namespace scattermeter::capture
