#include "solids.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/plain_math.h"

namespace hl {

namespace {

void addQuad(Model& model, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  if (a != b) model.triangles.push_back({a, b, c});
  if (c != d) model.triangles.push_back({a, c, d});
}

/// One turn of vertices at a point of a profile.
struct Ring {
  std::uint32_t first = 0;
  bool on_axis = false;
  std::uint32_t at(std::size_t side, std::size_t sides) const {
    return first + static_cast<std::uint32_t>(side % sides);
  }
};

// `slope`: the normal in the plane of the profile.
Ring addRing(Model& model, const ProfilePoint& point, const Vec2& slope, std::size_t sides) {
  Ring ring{static_cast<std::uint32_t>(model.positions.size()), !(point.radius > 0)};
  for (std::size_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sides);
    const Vec3 out(plain::cos(angle), 0, plain::sin(angle));
    model.positions.push_back(point.radius * out + Vec3(0, point.height, 0));
    model.normals.push_back((slope.x() * out + Vec3(0, slope.y(), 0)).normalized());
  }
  return ring;
}

// Outward is to the right of the way from `low` to `high`.
Vec2 normalOf(const ProfilePoint& low, const ProfilePoint& high) {
  return Vec2(high.height - low.height, low.radius - high.radius).normalized();
}

void addBand(Model& model, const Ring& low, const Ring& high, std::size_t sides) {
  for (std::size_t i = 0; i < sides; ++i) {
    const std::uint32_t a = low.at(i, sides), b = low.at(i + 1, sides), c = high.at(i, sides),
                        d = high.at(i + 1, sides);
    if (!high.on_axis) model.triangles.push_back({a, c, d});
    if (!low.on_axis) model.triangles.push_back({a, high.on_axis ? c : d, b});
  }
}

}  // namespace

Model boxSolid(const Vec3& half) {
  Model model;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 normal = Vec3::Zero(), u = Vec3::Zero(), v = Vec3::Zero();
      normal[axis] = side;
      u[(axis + 1) % 3] = half[(axis + 1) % 3];
      v[(axis + 2) % 3] = side * half[(axis + 2) % 3];
      const Vec3 centre = half[axis] * normal;
      const auto first = static_cast<std::uint32_t>(model.positions.size());
      for (const Vec3& corner :
           {Vec3(centre - u - v), Vec3(centre + u - v), Vec3(centre + u + v), Vec3(centre - u + v)}) {
        model.positions.push_back(corner);
        model.normals.push_back(normal);
      }
      addQuad(model, first, first + 1, first + 2, first + 3);
    }
  }
  return model;
}

// Each wedge is a box, bent: x goes outward, z around.
Model ringSolid(double inner, double outer, double half_height, std::size_t wedges) {
  const Model box = boxSolid(Vec3::Ones());
  Model model;
  for (std::size_t wedge = 0; wedge < wedges; ++wedge) {
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    for (const Vec3& corner : box.positions) {
      const std::size_t end = (wedge + (corner.z() > 0 ? 1 : 0)) % wedges;
      const double angle = 2 * std::numbers::pi * static_cast<double>(end) / static_cast<double>(wedges);
      const double radius = corner.x() > 0 ? outer : inner;
      model.positions.emplace_back(radius * std::cos(angle), half_height * corner.y(), radius * std::sin(angle));
    }
    for (const auto& t : box.triangles) {
      model.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      const auto at = [&](std::size_t i) -> const Vec3& { return model.positions[first + t[i]]; };
      const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      model.normals.resize(model.positions.size());
      for (const std::uint32_t corner : t) model.normals[first + corner] = normal;
    }
  }
  return model;
}

Model turnedSolid(const std::vector<ProfilePoint>& profile, std::size_t sides, bool smooth) {
  Model model;
  const std::size_t parts = profile.size() - 1;
  Ring ring;
  for (std::size_t i = 0; i < parts; ++i) {
    const Vec2 here = normalOf(profile[i], profile[i + 1]);
    const Vec2 below = smooth && i > 0 ? Vec2(here + normalOf(profile[i - 1], profile[i])) : here;
    const Vec2 above = smooth && i + 1 < parts ? Vec2(here + normalOf(profile[i + 1], profile[i + 2])) : here;
    if (i == 0 || !smooth) ring = addRing(model, profile[i], below, sides);
    const Ring next = addRing(model, profile[i + 1], above, sides);
    addBand(model, ring, next, sides);
    ring = next;
  }
  return model;
}

Model ballSolid(double radius, std::size_t sides) {
  std::vector<ProfilePoint> profile;
  const std::size_t parts = sides / 2;
  for (std::size_t i = 0; i <= parts; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / static_cast<double>(parts) - 0.5);
    const bool pole = i == 0 || i == parts;
    profile.push_back({pole ? 0 : radius * plain::cos(angle), radius * plain::sin(angle)});
  }
  return turnedSolid(profile, sides, true);
}

Model cylinderSolid(double radius, double half_height, std::size_t sides) {
  return turnedSolid({{0, -half_height}, {radius, -half_height}, {radius, half_height}, {0, half_height}}, sides,
                     false);
}

void appendSolid(Model& whole, Model part, const Vec3& at) {
  placeModel(part, {Mat3::Identity(), at});
  const auto first = static_cast<std::uint32_t>(whole.positions.size());
  whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
  whole.normals.insert(whole.normals.end(), part.normals.begin(), part.normals.end());
  for (const auto& t : part.triangles) whole.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace hl
