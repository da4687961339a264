// Placed shapes: what a client has in the world, before it is a part of a snapshot.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scene/snapshot.h"

namespace hl {

/// A shape at its final pose in the world, without its motion to that pose.
struct PlacedShape {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const Surfaces> surfaces;
  Pose pose;
  std::uint64_t key = 0;  ///< from the calls that lead to it: the same from frame to frame
  std::uint32_t session = 0, object = 0, name = 0;
  std::uint32_t item = 0;                     ///< as in Instance
  std::optional<Compliance> compliance{};     ///< of its object
  bool answers_force = false;                 ///< as in Instance
  std::shared_ptr<const BodySpec> body{};     ///< it is a rigid body that starts at `pose`; null: it is none
  std::shared_ptr<const SnapList> snaps{};    ///< in the frame of `pose`; null: none
  std::shared_ptr<const FieldList> fields{};  ///< the same
  std::shared_ptr<const Label> label{};       ///< as in Instance

  bool movesAsBody() const { return body && !body->fixed; }
};

/// The shapes in the world, and the joints of those that are bodies.
struct PlacedList : std::vector<PlacedShape> {
  using std::vector<PlacedShape>::vector;
  std::vector<JointSpec> joints;
};
/// Shared by all readers.
using PlacedShapes = std::shared_ptr<const PlacedList>;

}  // namespace hl
