// ItemList: what has been drawn into the world or into a definition, in order, before it becomes messages.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "client/attributes.h"
#include "client/geometry.h"
#include "client/matrix_stack.h"

namespace hl::client {

/// Primitives, or the call of an object, placed by a matrix.
struct Item {
  Matrix4 matrix = Matrix4::Identity();
  Look look;
  HLuint call = 0;  ///< > 0: a call, without geometry
  Geometry geometry;
};

/// What items need besides themselves.
struct Uses {
  std::set<HLuint> objects, textures;
};

/// The vertices of one item, which may be moved.
struct ItemVertices {
  std::uint32_t item = 0;  ///< number among all items of the list
  std::size_t count = 0;
  bool normals = false;
};

class ItemList {
 public:
  /// Appends primitives; takes `vertices` and leaves them empty. Those after each other with the same matrix, look, and
  /// presence of normals and texture coordinates become one item. Vertices that do not fill the last primitive are
  /// dropped; an `order` has none of them. Returns whether there was anything to add.
  bool draw(const Matrix4& matrix, const Look& look, HLenum mode, Vertices& vertices, DrawOrder order = {});
  /// `repeat`: factors of the texture coordinates u and v.
  void drawHeights(const Matrix4& matrix, const Look& look, proto::Heights heights,
                   const std::array<double, 2>& repeat);
  void drawCloud(const Matrix4& matrix, const Look& look, std::shared_ptr<proto::Cloud> cloud);
  /// The cloud that was drawn last; null: none was.
  proto::Cloud* lastCloud();
  /// `below`: the matter is where values are below iso.
  void drawVolume(const Matrix4& matrix, const Look& look, std::shared_ptr<const proto::Volume> volume, double iso,
                  bool below);
  /// Those after each other with the same matrix, look and error become one item, so that their sides meet.
  void drawPatch(const Matrix4& matrix, const Look& look, proto::Patch patch, double error_m);
  void drawImplicit(const Matrix4& matrix, const Look& look, std::shared_ptr<const proto::Implicit> implicit);
  /// The volume that was drawn last; null: none was.
  std::shared_ptr<const proto::Volume> lastVolume() const;
  void call(const Matrix4& matrix, const Look& look, HLuint object);

  const std::vector<Item>& items() const { return items_; }
  std::vector<Item>& items() { return items_; }
  Uses uses() const;
  /// What hlBody* says of the object; absent: it is no body.
  const std::optional<proto::Body>& body() const { return body_; }
  void setBody(const proto::Body& body) { body_ = body; }
  /// What hlSnap* says of the object.
  const std::vector<proto::Snap>& snaps() const { return snaps_; }
  std::vector<proto::Snap>& snaps() { return snaps_; }
  /// What hlField* says of it.
  const std::vector<proto::Field>& fields() const { return fields_; }
  std::vector<proto::Field>& fields() { return fields_; }
  /// Of the world; definitions have none.
  const std::vector<proto::WorldJoint>& joints() const { return joints_; }
  std::vector<proto::WorldJoint>& joints() { return joints_; }
  /// Numbers of the items that are surfaces of volumes.
  std::vector<std::uint32_t> volumes() const;
  /// Of all items that have some, in order.
  std::vector<ItemVertices> vertices() const;

 private:
  std::vector<Item> items_;
  std::optional<proto::Body> body_;
  std::vector<proto::Snap> snaps_;
  std::vector<proto::Field> fields_;
  std::vector<proto::WorldJoint> joints_;
};

}  // namespace hl::client
