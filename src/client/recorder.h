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
  /// Takes a vertex with the current normal and texture coordinates; nothing when it is not open.
  void vertex(const VertexExtras& extras, double x, double y, double z) {
    if (!open_) return;
    requireFinite(x, y, z);
    appendExtras(extras);
    const std::array<double, 3> position{x, y, z};
    vertices_.positions.insert(vertices_.positions.end(), position.begin(), position.end());
  }
  /// Ends the primitives and hands them over, valid until the next begin().
  Vertices& end();
  /// Ends them and forgets them.
  void cancel();

 private:
  void appendExtras(const VertexExtras& extras) {
    if (has_texcoords_ || extras.texcoord_set) appendTexcoord(extras.texcoord);  // the one that may throw
    if (has_normals_ || extras.normal != kNone) appendNormal(extras.normal);
  }
  void appendNormal(const std::array<double, 3>& normal);
  void appendTexcoord(const std::array<double, 2>& texcoord);
  std::array<double, 2> turned(const std::array<double, 2>& texcoord) const;

  static constexpr std::array<double, 3> kNone{};

  bool open_ = false;
  bool has_normals_ = false, has_texcoords_ = false;
  bool texture_turns_ = false;  // the texture matrix is not the identity
  HLenum mode_ = HL_POINTS;
  Eigen::Matrix<double, 2, 3> texture_;  // u' v' = texture_ * (u, v, 1)
  Vertices vertices_;
};

/// Throws Fault HL_INVALID_ENUM unless it is HL_POINTS .. HL_POLYGON.
void requirePrimitiveMode(HLenum mode);

}  // namespace hl::client
