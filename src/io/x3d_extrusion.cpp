#include "io/x3d_extrusion.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/direction.h"
#include "base/vec.h"
#include "io/x3d_sets.h"

namespace hl {

namespace {

using Frames = std::vector<Mat3>;

struct Extrusion {
  std::vector<Vec3> spine;
  std::vector<Vec2> section, scale;
  std::vector<Mat3> orientation;
  bool closed() const { return spine.size() > 2 && spine.front() == spine.back(); }
};

std::vector<double> numbersOf(const X3dTree& node, const char* field, std::vector<double> otherwise) {
  const auto text = x3dField(node, field);
  return text ? x3dNumbers(*text) : std::move(otherwise);
}

Extrusion extrusionOf(const X3dTree& node) {
  Extrusion out;
  const auto spine = numbersOf(node, "spine", {0, 0, 0, 0, 1, 0});
  const auto section = numbersOf(node, "crossSection", {1, 1, 1, -1, -1, -1, -1, 1, 1, 1});
  const auto scale = numbersOf(node, "scale", {1, 1}), turn = numbersOf(node, "orientation", {0, 0, 1, 0});
  for (std::size_t i = 0; i + 3 <= spine.size(); i += 3) out.spine.emplace_back(spine[i], spine[i + 1], spine[i + 2]);
  for (std::size_t i = 0; i + 2 <= section.size(); i += 2) out.section.emplace_back(section[i], section[i + 1]);
  for (std::size_t i = 0; i + 2 <= scale.size(); i += 2) out.scale.emplace_back(scale[i], scale[i + 1]);
  for (std::size_t i = 0; i + 4 <= turn.size(); i += 4) {
    const std::optional<Vec3> axis = unitOf({turn[i], turn[i + 1], turn[i + 2]});
    out.orientation.push_back(axis ? Eigen::AngleAxisd(turn[i + 3], *axis).toRotationMatrix() : Mat3(Mat3::Identity()));
  }
  if (out.scale.empty()) out.scale.emplace_back(1, 1);
  if (out.orientation.empty()) out.orientation.emplace_back(Mat3::Identity());
  return out;
}

// Of the spine at each of its points.
std::vector<Vec3> tangentsOf(const Extrusion& of) {
  const std::size_t n = of.spine.size();
  std::vector<Vec3> tangents;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : of.closed() ? n - 2 : 0;
    const std::size_t after = i + 1 < n ? i + 1 : of.closed() ? 1 : n - 1;
    const std::optional<Vec3> unit = unitOf(of.spine[after] - of.spine[before]);
    tangents.push_back(unit.value_or(tangents.empty() ? Vec3(Vec3::UnitY()) : tangents.back()));
  }
  return tangents;
}

// Where the spine bends, its z axis is at right angles to the bend; nothing where it goes straight on.
std::optional<Vec3> bendOf(const Extrusion& of, std::size_t i) {
  const std::size_t n = of.spine.size();
  if (!of.closed() && (i == 0 || i + 1 == n)) return std::nullopt;
  const Vec3& before = of.spine[i > 0 ? i - 1 : n - 2];
  const Vec3& after = of.spine[i + 1 < n ? i + 1 : 1];
  const std::optional<Vec3> a = unitOf(after - of.spine[i]), b = unitOf(before - of.spine[i]);
  constexpr double kStraight = 1e-9;  // rad
  if (!a || !b || a->cross(*b).norm() < kStraight) return std::nullopt;
  return unitOf(a->cross(*b));
}

// A straight spine turns the section as it is turned from y itself.
Frames framesOf(const Extrusion& of) {
  const std::vector<Vec3> tangents = tangentsOf(of);
  std::vector<std::optional<Vec3>> bends;
  for (std::size_t i = 0; i < of.spine.size(); ++i) bends.push_back(bendOf(of, i));
  const auto first = std::find_if(bends.begin(), bends.end(), [](const auto& bend) { return bend.has_value(); });
  Vec3 z = first != bends.end()
               ? **first
               : Vec3(Eigen::Quaterniond::FromTwoVectors(Vec3::UnitY(), tangents.front()) * Vec3::UnitZ());
  Frames frames;
  for (std::size_t i = 0; i < of.spine.size(); ++i) {
    if (bends[i]) z = bends[i]->dot(z) < 0 ? Vec3(-*bends[i]) : *bends[i];
    const Vec3 x = tangents[i].cross(z).normalized();
    Mat3 frame;
    frame << x, tangents[i], x.cross(tangents[i]);
    frames.push_back(frame);
  }
  return frames;
}

std::string pointsOf(const Extrusion& of) {
  const Frames frames = framesOf(of);
  std::string text;
  for (std::size_t i = 0; i < of.spine.size(); ++i) {
    const Vec2& scale = of.scale[std::min(i, of.scale.size() - 1)];
    const Mat3 turn = frames[i] * of.orientation[std::min(i, of.orientation.size() - 1)];
    for (const Vec2& c : of.section) {
      const Vec3 p = of.spine[i] + turn * Vec3(scale.x() * c.x(), 0, scale.y() * c.y());
      text += fmt::format("{} {} {} ", p.x(), p.y(), p.z());
    }
  }
  return text;
}

std::string facesOf(const Extrusion& of, bool begin_cap, bool end_cap) {
  const std::size_t n = of.section.size(), last = n * (of.spine.size() - 1);
  const std::size_t corners = of.section.front() == of.section.back() ? n - 1 : n;
  std::string text;
  for (std::size_t at = 0; at < last; at += n) {
    for (std::size_t j = at; j + 1 < at + n; ++j) text += fmt::format("{} {} {} {} -1 ", j, j + 1, j + 1 + n, j + n);
  }
  for (std::size_t j = corners; begin_cap && j > 0; --j) text += std::to_string(j - 1) + (j > 1 ? " " : " -1 ");
  for (std::size_t j = 0; end_cap && j < corners; ++j)
    text += std::to_string(last + j) + (j + 1 < corners ? " " : " -1 ");
  return text;
}

}  // namespace

void makeExtrusion(X3dTree& extrusion) {
  const Extrusion of = extrusionOf(extrusion);
  const auto has = [&](const char* cap) { return x3dField(extrusion, cap) != "false"; };
  const bool begin_cap = has("beginCap"), end_cap = has("endCap");
  for (const char* field : {"spine", "crossSection", "scale", "orientation", "beginCap", "endCap"})
    eraseX3dField(extrusion, field);
  if (of.spine.size() < 2 || of.section.size() < 2) return;
  setX3dField(extrusion, "coordIndex", facesOf(of, begin_cap, end_cap));
  X3dTree coordinates;
  setX3dField(coordinates, "point", pointsOf(of));
  extrusion.push_back({"Coordinate", coordinates});
}

}  // namespace hl
