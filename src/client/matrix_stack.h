// MatrixStack: GL's matrix calls. The top matrix is affine, and as a modelview matrix invertible, at all times.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "base/vec.h"

namespace hl::client {

using Matrix4 = Eigen::Matrix4d;  ///< column by column in memory, as GL's

/// As deep as GL demands of modelview and of texture matrices, and a little more for the latter.
inline constexpr std::size_t kModelviewDepth = 32;
inline constexpr std::size_t kTextureDepth = 8;

/// Every function throws Fault and changes nothing where hl.h says so.
class MatrixStack {
 public:
  enum class Kind { kModelview, kTexture };
  explicit MatrixStack(Kind kind) : kind_(kind) {}

  const Matrix4& top() const { return stack_.back(); }
  std::size_t depth() const { return stack_.size(); }
  /// The same as top() == Identity, kept at hand for every vertex.
  bool isIdentity() const { return is_identity_; }

  void push();
  void pop();
  void load(const Matrix4& matrix);
  void multiply(const Matrix4& matrix);
  void translate(const Vec3& shift);
  void rotate(double degrees, const Vec3& axis);
  void scale(const Vec3& factors);

 private:
  void setTop(const Matrix4& matrix);

  Kind kind_;
  std::vector<Matrix4> stack_{Matrix4::Identity()};
  bool is_identity_ = true;
};

}  // namespace hl::client
