#include "depth_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/plain_math.h"

namespace hl {

namespace {

constexpr std::uint32_t kColumns = 640, kRows = 480;
constexpr double kFocal = 525.0 / kColumns;  // of the width
constexpr double kUnit_m = 1e-4, kFar = std::numeric_limits<double>::infinity();

/// A ray from the camera, in the frame of the table.
struct Ray {
  Vec3 from, way;
};

double alongTable(const Ray& ray) {
  constexpr double kRadius = 0.22;
  const double t = -ray.from.y() / ray.way.y();
  return t > 0 && (ray.from + t * ray.way).norm() <= kRadius ? t : kFar;
}

// Of A t^2 + 2 B t + C = 0 the first t at which `counts` holds.
template <typename Counts>
double firstRoot(double a, double b, double c, const Counts& counts) {
  const double square = b * b - a * c;
  if (!(square >= 0) || a == 0) return kFar;
  for (const double sign : {-1.0, 1.0}) {
    const double t = (-b + sign * std::sqrt(square)) / a;
    if (t > 0 && counts(t)) return t;
  }
  return kFar;
}

double alongBall(const Ray& ray) {
  constexpr double kRadius = 0.035;
  const Vec3 from = ray.from - Vec3(-0.09, kRadius, 0.01);
  return firstRoot(ray.way.squaredNorm(), ray.way.dot(from), from.squaredNorm() - kRadius * kRadius,
                   [](double) { return true; });
}

// Upright, of the height H: x^2 + z^2 = (R (1 - y / H))^2.
double alongCone(const Ray& ray) {
  constexpr double kRadius = 0.04, kHeight = 0.09, kSlope = kRadius / kHeight;
  const Vec3 from = ray.from - Vec3(0.02, 0, -0.05);
  const double below = kSlope * (kHeight - from.y()), falls = -kSlope * ray.way.y();
  const double a = ray.way.x() * ray.way.x() + ray.way.z() * ray.way.z() - falls * falls;
  const double b = ray.way.x() * from.x() + ray.way.z() * from.z() - falls * below;
  const double c = from.x() * from.x() + from.z() * from.z() - below * below;
  return firstRoot(a, b, c, [&](double t) {
    const double y = from.y() + t * ray.way.y();
    return y >= 0 && y <= kHeight;
  });
}

double alongBox(const Ray& ray) {
  const Vec3 middle(0.11, 0.025, 0.03), half(0.03, 0.025, 0.04);
  double enter = 0, leave = kFar;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double a = (middle[axis] - half[axis] - ray.from[axis]) / ray.way[axis];
    const double b = (middle[axis] + half[axis] - ray.from[axis]) / ray.way[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : kFar;
}

// Turned about x: the camera looks along its -z, here down by 55 degrees.
Mat3 turnOfCamera() {
  const double angle = 55 * EIGEN_PI / 180, s = plain::sin(angle), c = plain::cos(angle);
  Mat3 turn;
  turn << 1, 0, 0, 0, c, s, 0, -s, c;
  return turn;
}

Vec3 eyeOfCamera() { return -0.6 * (turnOfCamera() * -Vec3::UnitZ()); }

}  // namespace

HeightGrid DepthPicture::grid() const {
  return {{columns, rows, SampleKind::kUint16}, {std::shared_ptr<const void>(), depths.data()}};
}

DepthPicture pictureOfTable(std::uint32_t columns, std::uint32_t rows) {
  const double focal = kFocal * columns;
  DepthPicture picture{columns, rows, kUnit_m, {focal, focal, 0.5 * (columns - 1.0), 0.5 * (rows - 1.0)}, {}};
  const Mat3 turn = turnOfCamera();
  const Vec3 eye = eyeOfCamera();
  picture.depths.reserve(std::size_t{columns} * rows);
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const Ray ray{eye, turn * Vec3(picture.camera.across(column), -picture.camera.down(row), -1)};
      const double depth_m = std::min({alongTable(ray), alongBall(ray), alongCone(ray), alongBox(ray)});
      picture.depths.push_back(depth_m < 6 ? static_cast<std::uint16_t>(std::lround(depth_m / kUnit_m)) : 0);
    }
  }
  return picture;
}

GridFrame frameOfTable() { return cameraFrame(1).placed(turnOfCamera(), eyeOfCamera()); }

std::shared_ptr<const PrimitiveSource> makeDepthTable() {
  const DepthPicture picture = pictureOfTable(kColumns, kRows);
  return std::make_shared<const DepthFrame>(smoothed(picture.grid(), picture.unit_m, picture.camera, nullptr, 0),
                                            frameOfTable());
}

}  // namespace hl
