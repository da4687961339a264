// Model: the output of a file reader or generator: vertices with optional normals and texture coordinates, and index
// lists.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/rgb.h"
#include "base/vec.h"
#include "geometry/box.h"
#include "scene/appearance.h"
#include "scene/material.h"
#include "scene/texture.h"

namespace hl {

/// How the surfaces of a CAD file became triangles.
struct CadReading {
  double deflection_m = 0;   ///< asked for: distance between an edge and its curve
  double angle_rad = 0;      ///< asked for: between neighbouring pieces of a curve
  double error_m = 0;        ///< largest distance found between a triangle and its surface
  double tolerance_m = 0;    ///< largest in the file: how far its edges may be from their faces
  std::uint64_t solids = 0;  ///< closed bodies
  std::uint64_t faces = 0;
};

/// Changes made while reading a file, for `hl info`.
struct Reading {
  std::size_t joined_vertices = 0;  ///< vertices joined with identical ones: see weldVertices()
  bool single_precision = false;    ///< some coordinates were read by a reader with 24 bits of precision
  std::optional<CadReading> cad{};  ///< of several files: the largest lengths, and all faces
  double patch_error_m = 0;         ///< bound of the distance between its triangles and the patches that they stand for
  /// Of a model that `other` becomes part of.
  void add(const Reading& other);
  /// Of a model whose lengths grow by `factor` at most.
  void scale(double factor);
};

/// More objects than these stay one.
inline constexpr std::size_t kMaxModelParts = 4096;

/// An object that a model is made of: so many of the vertices and elements of its lists.
struct ModelPart {
  std::string name;
  std::optional<Rgb> colour{};  ///< absent: the file gives it none
  std::uint32_t vertices = 0, triangles = 0, segments = 0;
};

/// Metres, world frame. Index lists refer to `positions`; polygons have been triangulated.
struct Model {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;    ///< one per position, or empty; zero means no normal
  std::vector<Vec2> texcoords;  ///< one per position, or empty
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> segments;
  std::vector<std::uint32_t> points;
  std::vector<Material> materials{Material{}};  ///< at least one; elements without a material number use 0
  std::vector<std::uint16_t> triangle_materials, segment_materials, point_materials;  ///< one per element, or empty
  std::vector<Texture> textures;
  Appearance appearance;              ///< shown, not felt
  std::vector<std::string> warnings;  ///< what was skipped while reading, one line each, with counts
  Reading reading;
  std::vector<ModelPart> parts;  ///< objects that it is made of, one after the other; empty: it is one

  Box bounds() const;  ///< of the vertices that an element uses
  std::vector<Vec3> usedPositions() const;
  std::size_t elements() const { return triangles.size() + segments.size() + points.size(); }
};

/// x -> linear x + offset; metres.
struct Placement {
  Mat3 linear = Mat3::Identity();
  Vec3 offset = Vec3::Zero();

  /// The placement that applies `inner` first, then this one.
  Placement operator*(const Placement& inner) const { return {linear * inner.linear, linear * inner.offset + offset}; }
};

/// Moves positions by the placement and normals by its inverse transpose. `linear` must be invertible.
void placeModel(Model& model, const Placement& placement);
/// Scales about the origin by `factor` > 0.
void scaleModel(Model& model, double factor);
/// Scales uniformly and centres on the origin so that the largest side of the bounds is `side` metres. Returns the
/// factor.
double fitModel(Model& model, double side);

}  // namespace hl
