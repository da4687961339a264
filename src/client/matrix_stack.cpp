#include "client/matrix_stack.h"

#include <cmath>

#include "client/fault.h"

namespace hl::client {

namespace {

// Nothing can be touched of what a singular matrix places: it has no extent.
bool isInvertible(const Matrix4& matrix) {
  const double determinant = matrix.topLeftCorner<3, 3>().determinant();
  return determinant != 0 && allFinite(determinant);
}

void requireAffine(const Matrix4& matrix) {
  if (!matrix.allFinite()) throw Fault(HL_INVALID_VALUE, "numbers must be finite");
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw Fault(HL_INVALID_VALUE, "the last row of a matrix must be 0 0 0 1");
}

Matrix4 linear(const Mat3& part) {
  Matrix4 matrix = Matrix4::Identity();
  matrix.topLeftCorner<3, 3>() = part;
  return matrix;
}

}  // namespace

void MatrixStack::setTop(const Matrix4& matrix) {
  if (!matrix.allFinite()) throw Fault(HL_INVALID_VALUE, "the matrix would not be finite");
  if (kind_ == Kind::kModelview && !isInvertible(matrix))
    throw Fault(HL_INVALID_VALUE, "the matrix could not be inverted in double precision");
  stack_.back() = matrix;
  is_identity_ = matrix == Matrix4::Identity();
}

void MatrixStack::push() {
  const std::size_t most = kind_ == Kind::kModelview ? kModelviewDepth : kTextureDepth;
  if (stack_.size() >= most) throw Fault(HL_STACK_OVERFLOW, "the matrix stack is full");
  stack_.push_back(Matrix4(top()));
}

void MatrixStack::pop() {
  if (stack_.size() == 1) throw Fault(HL_STACK_UNDERFLOW, "no matrix has been pushed");
  stack_.pop_back();
  is_identity_ = top() == Matrix4::Identity();
}

void MatrixStack::load(const Matrix4& matrix) {
  requireAffine(matrix);
  setTop(matrix);
}

void MatrixStack::multiply(const Matrix4& matrix) {
  requireAffine(matrix);
  setTop(top() * matrix);
}

void MatrixStack::translate(const Vec3& shift) {
  requireFinite(shift.x(), shift.y(), shift.z());
  Matrix4 matrix = Matrix4::Identity();
  matrix.col(3).head<3>() = shift;
  setTop(top() * matrix);
}

void MatrixStack::rotate(double degrees, const Vec3& axis) {
  requireFinite(degrees, axis.x(), axis.y(), axis.z());
  const Vec3 unit = axis.stableNormalized();
  if (unit.isZero(0)) throw Fault(HL_INVALID_VALUE, "the axis must not be 0");
  setTop(top() * linear(Eigen::AngleAxisd(degrees * (M_PI / 180), unit).toRotationMatrix()));
}

void MatrixStack::scale(const Vec3& factors) {
  requireFinite(factors.x(), factors.y(), factors.z());
  setTop(top() * linear(factors.asDiagonal()));
}

}  // namespace hl::client
