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
  origin_texcoord_ = turned({});
  vertices_.clear();
}

// Nothing is noted before nothing can fail any more, so that the lists stay as long as each other.
void Recorder::vertex(const VertexExtras& extras, double x, double y, double z) {
  if (!open_) return;
  requireFinite(x, y, z);
  const std::array<double, 2> texcoord = turned(extras.texcoord);
  const bool normals = has_normals_ || extras.has_normal, texcoords = has_texcoords_ || extras.has_texcoord;
  const std::size_t count = vertices_.size() + 1;
  vertices_.positions.makeRoom(3);
  if (normals) vertices_.normals.makeRoom(3 * count - vertices_.normals.size());
  if (texcoords) vertices_.texcoords.makeRoom(2 * count - vertices_.texcoords.size());
  if (normals) appendNormal(extras.normal);
  if (texcoords) appendTexcoord(texcoord);
  vertices_.positions.appendInRoom<3>({x, y, z});
}

// The vertices before the first normal had none.
void Recorder::appendNormal(const std::array<double, 3>& normal) {
  if (!has_normals_)
    for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_.normals.appendInRoom<3>({0, 0, 0});
  has_normals_ = true;
  vertices_.normals.appendInRoom(normal);
}

// The vertices before the first coordinates had those that GL begins with, 0 0.
void Recorder::appendTexcoord(const std::array<double, 2>& texcoord) {
  if (!has_texcoords_)
    for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_.texcoords.appendInRoom(origin_texcoord_);
  has_texcoords_ = true;
  vertices_.texcoords.appendInRoom(texcoord);
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
