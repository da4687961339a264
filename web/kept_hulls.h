// Kept hulls: the faces of the hulls of the built-in scenes, as qhull has found them, for a browser, which has no
// qhull.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bodies/hull_faces.h"

namespace hl {

/// One line for each hull: a number of the points' bits, the error, the vertices, and the corners of each face.
std::string_view keptHulls();
/// The line of such a hull.
std::string lineOf(const std::vector<Vec3>& points, const HullFaces& hull);
/// The hull of these points; absent: it is none of the lines.
std::optional<HullFaces> keptHull(std::string_view lines, const std::vector<Vec3>& points);

}  // namespace hl
