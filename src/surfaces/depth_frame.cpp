#include "surfaces/depth_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "surfaces/depth_index.h"
#include "surfaces/normal_between.h"

namespace hl {

using Pixel = DepthCells::Pixel;

namespace {

constexpr double kSiteRounding = 1e-12;  // of the product of a depth and another's inverse

}  // namespace

DepthFrame::DepthFrame(std::shared_ptr<const DepthImage> seen, const GridFrame& frame)
    : cells_(std::move(seen), frame), inverse_(frame.axes.inverse()) {
  checkCamera(image().camera);
  if (!frame.axes.allFinite() || !frame.origin.allFinite() || !inverse_.allFinite())
    throw Error("the axes of a depth camera must be numbers, and not lie in one plane");
  if (triangles() == 0) return;
  bounds_ = boundsOfTiles();
  if (!withinReach(bounds_.min) || !withinReach(bounds_.max)) throw Error("a depth image reaches beyond 1e9 m");
}

// Each tile lies within its piece of the frustum. Only those that reach beyond what is known are looked into.
Box DepthFrame::boundsOfTiles() const {
  Box box;
  extendBy(image().tiles.levels() - 1, 0, 0, box);
  return box;
}

void DepthFrame::extendBy(int level, std::uint32_t column, std::uint32_t row, Box& box) const {
  const DepthTiles& tiles = image().tiles;
  const DepthRange& range = tiles.range(level, column, row);
  if (range.empty()) return;
  const auto side = static_cast<double>(DepthTiles::side(level));
  Box piece;
  for (unsigned c = 0; c < 8; ++c) {
    const double i = std::min((column + (c & 1U)) * side, pixels().columns() - 1.0);
    const double j = std::min((row + (c >> 1U & 1U)) * side, pixels().rows() - 1.0);
    piece.extend(cells_.pointAt(i, j, (c >> 2U & 1U) != 0 ? range.high : range.low));
  }
  if (!box.empty() && box.contains(piece)) return;
  if (level == 0) {
    box.extend(piece.min);
    box.extend(piece.max);
    return;
  }
  const std::uint32_t end = std::min((column + 1) * DepthTiles::kTiles, tiles.columns(level - 1));
  const std::uint32_t bottom = std::min((row + 1) * DepthTiles::kTiles, tiles.rows(level - 1));
  for (std::uint32_t j = row * DepthTiles::kTiles; j < bottom; ++j) {
    for (std::uint32_t i = column * DepthTiles::kTiles; i < end; ++i) extendBy(level - 1, i, j, box);
  }
}

ElementId DepthFrame::count() const {
  return triangles() == 0 ? 0 : 2 * ElementId{pixels().columns() - 1} * (pixels().rows() - 1);
}

// From before to after `here`, along an axis of the image; nothing where neither is one surface with it.
Vec3 DepthFrame::normalAt(std::uint32_t column, std::uint32_t row, const Vec3& otherwise) const {
  const float here = cells_.depthAt({column, row});
  const auto slope = [&](std::uint32_t end, std::uint32_t at, const auto& pixel) {
    const auto joined = [&](std::uint32_t other) {
      return image().camera.joins(here, here, cells_.depthAt(pixel(other)));
    };
    const Pixel first = pixel(at > 0 && joined(at - 1) ? at - 1 : at);
    const Pixel last = pixel(at + 1 < end && joined(at + 1) ? at + 1 : at);
    return Vec3(cells_.pointAt(last) - cells_.pointAt(first));
  };
  const Vec3 across = slope(pixels().columns(), column, [&](std::uint32_t i) { return Pixel{i, row}; });
  const Vec3 down = slope(pixels().rows(), row, [&](std::uint32_t j) { return Pixel{column, j}; });
  const Vec3 normal = cells_.mirrored() ? across.cross(down) : down.cross(across);
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : otherwise;
}

Vec3 DepthFrame::trueNormal(ElementId id, const Vec3& point) const {
  const std::array<Pixel, 3> at = cells_.pixelsOf(cellOf(id, pixels().columns()));
  const std::array<Vec3, 3> corner = corners(id);
  const Vec3 flat = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  const Vec3 normal = normalBetween(corner, point, [&](std::size_t i) { return normalAt(at[i][0], at[i][1], flat); });
  return normal.isZero(0) ? flat : normal;
}

// The middle of the pixel, so that an image of as many pixels has its texel there.
Vec2 DepthFrame::texcoordAt(const Pixel& pixel) const {
  const double columns = pixels().columns(), rows = pixels().rows();
  return {(pixel[0] + 0.5) / columns, (rows - pixel[1] - 0.5) / rows};
}

std::unique_ptr<const SpatialIndex> DepthFrame::makeIndex() const {
  return std::make_unique<DepthIndex>(cells_, bounds_);
}

Site DepthFrame::siteOf(const Vec3& point) const {
  const Vec3 q = inverse_ * (point - frame().origin);
  if (!(q.z() > 0)) return Site::kOpen;
  const DepthCamera& camera = image().camera;
  const double u = camera.cx + camera.fx * q.x() / q.z(), v = camera.cy + camera.fy * q.y() / q.z();
  if (!(u >= 0 && v >= 0 && u < pixels().columns() - 1.0 && v < pixels().rows() - 1.0)) return Site::kOpen;
  const auto i = static_cast<std::uint32_t>(u), j = static_cast<std::uint32_t>(v);
  const double nearer = cells_.nearness({i, j, u - i >= v - j ? 0U : 1U}, u, v) * q.z();
  if (nearer > 0)
    return nearer > 1 + kSiteRounding ? Site::kMatter : nearer < 1 - kSiteRounding ? Site::kOpen : Site::kBoundary;
  return siteInGap({i, j}, q.z());
}

// Where no triangle is, it is behind the surface if it is behind all that is around.
Site DepthFrame::siteInGap(const Pixel& pixel, double depth) const {
  const auto [i, j] = pixel;
  float low = std::numeric_limits<float>::infinity(), high = 0;
  for (const float corner :
       {pixels().at(i, j), pixels().at(i + 1, j), pixels().at(i, j + 1), pixels().at(i + 1, j + 1)}) {
    if (!(corner > 0)) continue;
    low = std::min(low, corner);
    high = std::max(high, corner);
  }
  if (!(depth >= low)) return Site::kOpen;
  if (depth > high) return Site::kMatter;
  return image().camera.joins(low, low, high) ? Site::kBoundary : Site::kOpen;
}

std::shared_ptr<const PrimitiveSource> DepthFrame::placed(const Mat3& linear, const Vec3& offset) const {
  return std::make_shared<const DepthFrame>(cells_.image(), frame().placed(linear, offset));
}

DrawnMesh DepthFrame::drawn(std::size_t most_triangles) const {
  std::uint32_t step = 1;
  const auto cells = [&](std::uint32_t side) { return std::size_t{(side - 1) / step}; };
  while (2 * cells(pixels().columns()) * cells(pixels().rows()) > most_triangles) ++step;
  return every(step);
}

DrawnMesh DepthFrame::every(std::uint32_t step) const {
  const std::uint32_t columns = (pixels().columns() - 1) / step + 1, rows = (pixels().rows() - 1) / step + 1;
  DrawnMesh mesh;
  constexpr std::uint32_t kNone = ~0U;
  std::vector<std::uint32_t> number(std::size_t{columns} * rows, kNone);
  const auto vertex = [&](const Pixel& pixel) {
    std::uint32_t& place = number[std::size_t{pixel[1] / step} * columns + pixel[0] / step];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(cells_.pointAt(pixel));
      mesh.normals.push_back(normalAt(pixel[0], pixel[1], Vec3::UnitZ()));
      mesh.texcoords.push_back(texcoordAt(pixel));
    }
    return place;
  };
  const DepthCamera wide{1, 1, 0, 0, std::min(1.0, step * image().camera.join)};
  for (std::uint32_t j = 0; j + 1 < rows; ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      for (const unsigned half : {0U, 1U}) {
        std::array<Pixel, 3> at = cells_.pixelsOf({i, j, half});
        for (Pixel& pixel : at) pixel = {pixel[0] * step, pixel[1] * step};
        if (!wide.joins(cells_.depthAt(at[0]), cells_.depthAt(at[1]), cells_.depthAt(at[2]))) continue;
        mesh.triangles.push_back({vertex(at[0]), vertex(at[1]), vertex(at[2])});
      }
    }
  }
  return mesh;
}

GridFrame cameraFrame(double scale_m) { return {scale_m * Vec3(1, -1, -1).asDiagonal().toDenseMatrix(), Vec3::Zero()}; }

}  // namespace hl
