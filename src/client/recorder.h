// Recorder: between hlBegin and hlEnd. hlVertex is the call that is made millions of times, so it only appends numbers
// to plain buffers that keep their memory from one hlBegin to the next.
#pragma once

#include <array>

#include "client/attributes.h"
#include "client/fault.h"
#include "client/geometry.h"
#include "client/matrix_stack.h"

namespace hl::client {

class Recorder {
 public:
  bool isOpen() const { return open_; }
  HLenum mode() const { return mode_; }
  /// Throws Fault HL_INVALID_ENUM. `texture` stays the texture matrix until end(); `textured`: vertices need texture
  /// coordinates even if the application gives none.
  void begin(HLenum mode, const MatrixStack& texture, bool textured);
  /// Takes a vertex with the current normal and texture coordinates; nothing when it is not open. Throws Fault
  /// HL_INVALID_VALUE.
  void vertex(const VertexExtras& extras, double x, double y, double z);
  /// The same where it is enough to append numbers for which there is room; else it returns false and has done nothing.
  bool vertexInRoom(const VertexExtras& extras, double x, double y, double z) noexcept {
    const bool first_extra = extras.has_normal > has_normals_ || extras.has_texcoord > has_texcoords_;
    if (!open_ || first_extra || texture_turns_ || !hasRoom() || !allFinite(x, y, z)) return false;
    if (has_normals_) vertices_.normals.appendInRoom(extras.normal);
    if (has_texcoords_) vertices_.texcoords.appendInRoom(extras.texcoord);
    vertices_.positions.appendInRoom<3>({x, y, z});
    return true;
  }
  /// Ends the primitives and hands them over, valid until the next begin().
  Vertices& end();
  /// Ends them and forgets them.
  void cancel();

 private:
  bool hasRoom() const {
    return vertices_.positions.hasRoom(3) && (!has_normals_ || vertices_.normals.hasRoom(3)) &&
           (!has_texcoords_ || vertices_.texcoords.hasRoom(2));
  }
  void appendNormal(const std::array<double, 3>& normal);
  void appendTexcoord(const std::array<double, 2>& texcoord);
  std::array<double, 2> turned(const std::array<double, 2>& texcoord) const;

  bool open_ = false;
  bool has_normals_ = false, has_texcoords_ = false;
  bool texture_turns_ = false;  // the texture matrix is not the identity
  HLenum mode_ = HL_POINTS;
  Eigen::Matrix<double, 2, 3> texture_;      // u' v' = texture_ * (u, v, 1)
  std::array<double, 2> origin_texcoord_{};  // 0 0, turned
  Vertices vertices_;
};

/// Throws Fault HL_INVALID_ENUM unless it is HL_POINTS .. HL_POLYGON.
void requirePrimitiveMode(HLenum mode);

}  // namespace hl::client
