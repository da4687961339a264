#include "bodies/placed_bodies.h"

#include <cmath>

namespace hl {

namespace {

const Convex& topologyOf(PrimitiveKind kind) {
  static const Convex point = [] {
    Convex shape;
    shape.vertices.resize(1);
    return shape;
  }();
  static const Convex segment = [] {
    Convex shape = capsuleShape(1, 0);
    shape.reach = 0;
    return shape;
  }();
  static const Convex triangle = triangleTopology();
  if (kind == PrimitiveKind::kPoint) return point;
  return kind == PrimitiveKind::kSegment ? segment : triangle;
}

}  // namespace

PlacedConvex placed(const Convex& shape, const BodyState& state, std::span<Vec3> vertices, std::span<Vec3> normals) {
  const Mat3 rotation = state.turned.toRotationMatrix();
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) vertices[i] = state.centre + rotation * shape.vertices[i];
  for (std::size_t i = 0; i < shape.faces.size(); ++i) normals[i] = rotation * shape.faces[i].normal;
  return {&shape, vertices.first(shape.vertices.size()), normals.first(shape.faces.size()),
          state.centre + rotation * shape.middle};
}

PlacedConvex placed(const Convex& part, const BodyState& state, PlacedRoom& room) {
  return placed(part, state, room.vertices, room.normals);
}

PlacedConvex placed(const Primitive& primitive, const Pose& pose, PlacedRoom& room) {
  const Convex& shape = topologyOf(primitive.kind);
  const std::size_t vertices = shape.vertices.size();
  for (std::size_t i = 0; i < vertices; ++i) room.vertices[i] = pose.toWorld(primitive.vertex[i]);
  PlacedConvex out{&shape, std::span<const Vec3>(room.vertices).first(vertices), {}, Vec3::Zero()};
  for (const Vec3& vertex : out.vertices) out.centre += vertex / static_cast<double>(vertices);
  if (primitive.kind != PrimitiveKind::kTriangle) return out;
  // The corners are sorted, so that the face may wind the other way round.
  room.normals[0] = (room.vertices[1] - room.vertices[0]).cross(room.vertices[2] - room.vertices[0]).normalized();
  room.normals[1] = -room.normals[0];
  out.normals = std::span<const Vec3>(room.normals).first(2);
  return out;
}

// The topologies are made here, and not in the step in which a body first meets a primitive.
PlacedBodies::PlacedBodies(const World& world) {
  topologyOf(PrimitiveKind::kTriangle);
  std::size_t vertices = 0, normals = 0;
  for (const Body& body : world.bodies) {
    first_part_.push_back(first_vertex_.size());
    poses_.emplace_back(Vec3::Constant(NAN), Eigen::Quaterniond::Identity());
    for (const Convex& part : body.shape.parts) {
      first_vertex_.push_back(vertices);
      first_normal_.push_back(normals);
      vertices += part.vertices.size();
      normals += part.faces.size();
    }
  }
  first_part_.push_back(first_vertex_.size());
  placed_.resize(first_vertex_.size());
  vertices_.resize(vertices);
  normals_.resize(normals);
}

void PlacedBodies::place(const World& world, const WorldState& state) {
  for (std::size_t i = 0; i < world.bodies.size(); ++i) place(world.bodies[i], i, state.bodies[i]);
}

// What has not moved since the last time, as what sleeps, stays as it is.
void PlacedBodies::place(const Body& body, std::size_t number, const BodyState& state) {
  auto& [centre, turned] = poses_[number];
  if (centre == state.centre && turned.coeffs() == state.turned.coeffs()) return;
  centre = state.centre;
  turned = state.turned;
  std::size_t i = first_part_[number];
  for (const Convex& part : body.shape.parts) {
    placed_[i] = placed(part, state, std::span(vertices_).subspan(first_vertex_[i]),
                        std::span(normals_).subspan(first_normal_[i]));
    ++i;
  }
}

}  // namespace hl
