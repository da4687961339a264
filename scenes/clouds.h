// Generated clouds of points, y up, 0.2 m across.
#pragma once

#include <cstddef>
#include <memory>

#include "surfaces/point_cloud.h"

namespace hl {

/// N points evenly spread over a sphere of 0.1 m radius, with its normals.
std::shared_ptr<const PointCloud> makeSphereCloud(std::size_t points);

/// N points at random places on the hills of makeTerrain(), as a scanner sees them: without normals.
std::shared_ptr<const PointCloud> makeTerrainCloud(std::size_t points);

}  // namespace hl
