#include "client/recorder.h"

namespace hl::client {

void requirePrimitiveMode(HLenum mode) {
  if (mode > HL_POLYGON) throw Fault(HL_INVALID_ENUM, "the mode must be HL_POINTS .. HL_POLYGON");
}

void Recorder::begin(HLenum mode, const MatrixStack& texture, bool textured) {
  requirePrimitiveMode(mode);
  open_ = true;
  mode_ = mode;
  has_normals_ = false;
  has_texcoords_ = textured;
  texture_turns_ = !texture.isIdentity();
  texture_ << texture.top().topLeftCorner<2, 2>(), texture.top().topRightCorner<2, 1>();
  vertices_.clear();
}

// The vertices before the first normal had none.
void Recorder::appendNormal(const std::array<double, 3>& normal) {
  if (!has_normals_) vertices_.normals.assign(vertices_.positions.size(), 0);
  has_normals_ = true;
  vertices_.normals.insert(vertices_.normals.end(), normal.begin(), normal.end());
}

void Recorder::appendTexcoord(const std::array<double, 2>& texcoord) {
  const std::array<double, 2> now = turned(texcoord);
  // The vertices before the first coordinates had those that GL begins with, 0 0.
  if (!has_texcoords_) {
    const std::array<double, 2> before = turned({});
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      vertices_.texcoords.insert(vertices_.texcoords.end(), before.begin(), before.end());
    has_texcoords_ = true;
  }
  vertices_.texcoords.insert(vertices_.texcoords.end(), now.begin(), now.end());
}

std::array<double, 2> Recorder::turned(const std::array<double, 2>& texcoord) const {
  if (!texture_turns_) return texcoord;
  const Eigen::Vector2d out = texture_ * Eigen::Vector3d(texcoord[0], texcoord[1], 1);
  requireFinite(out.x(), out.y());
  return {out.x(), out.y()};
}

Vertices& Recorder::end() {
  open_ = false;
  return vertices_;
}

void Recorder::cancel() {
  open_ = false;
  vertices_.clear();
}

}  // namespace hl::client
