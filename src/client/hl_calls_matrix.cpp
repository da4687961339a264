// Matrices. Angles are degrees here and nowhere else in HL.
#include <hl/hl.h>

#include "client/call.h"

using hl::Vec3;
using hl::client::call;
using hl::client::Fault;
using hl::client::Matrix4;
using hl::client::requirePointer;

namespace {

template <typename Number>
Matrix4 matrixOf(const Number* m) {
  requirePointer(m);
  return Eigen::Map<const Eigen::Matrix<Number, 4, 4>>(m).template cast<double>();
}

template <typename Number>
void load(const char* function, const Number* m) {
  call(function, [&](HLcontext& context) { context.draw.matrices().load(matrixOf(m)); });
}

template <typename Number>
void multiply(const char* function, const Number* m) {
  call(function, [&](HLcontext& context) { context.draw.matrices().multiply(matrixOf(m)); });
}

void translate(const char* function, const Vec3& shift) {
  call(function, [&](HLcontext& context) { context.draw.matrices().translate(shift); });
}

void rotate(const char* function, double degrees, const Vec3& axis) {
  call(function, [&](HLcontext& context) { context.draw.matrices().rotate(degrees, axis); });
}

void scale(const char* function, const Vec3& factors) {
  call(function, [&](HLcontext& context) { context.draw.matrices().scale(factors); });
}

}  // namespace

void hlMatrixMode(HLenum mode) {
  call(__func__, [&](HLcontext& context) {
    if (mode != HL_MODELVIEW && mode != HL_TEXTURE)
      throw Fault(HL_INVALID_ENUM, "the mode must be HL_MODELVIEW or HL_TEXTURE");
    context.draw.attributes.now.matrix_mode = mode;
  });
}

void hlPushMatrix(void) {
  call(__func__, [](HLcontext& context) { context.draw.matrices().push(); });
}

void hlPopMatrix(void) {
  call(__func__, [](HLcontext& context) { context.draw.matrices().pop(); });
}

void hlLoadIdentity(void) {
  call(__func__, [](HLcontext& context) { context.draw.matrices().load(Matrix4::Identity()); });
}

void hlLoadMatrixf(const HLfloat* m) { load(__func__, m); }
void hlLoadMatrixd(const HLdouble* m) { load(__func__, m); }
void hlMultMatrixf(const HLfloat* m) { multiply(__func__, m); }
void hlMultMatrixd(const HLdouble* m) { multiply(__func__, m); }
void hlTranslatef(HLfloat x, HLfloat y, HLfloat z) { translate(__func__, Vec3(x, y, z)); }
void hlTranslated(HLdouble x, HLdouble y, HLdouble z) { translate(__func__, Vec3(x, y, z)); }
void hlRotatef(HLfloat degrees, HLfloat x, HLfloat y, HLfloat z) { rotate(__func__, degrees, Vec3(x, y, z)); }
void hlRotated(HLdouble degrees, HLdouble x, HLdouble y, HLdouble z) { rotate(__func__, degrees, Vec3(x, y, z)); }
void hlScalef(HLfloat x, HLfloat y, HLfloat z) { scale(__func__, Vec3(x, y, z)); }
void hlScaled(HLdouble x, HLdouble y, HLdouble z) { scale(__func__, Vec3(x, y, z)); }
