// Compiled once for each instruction set (foreach_target includes this file again). Multiplications and additions are
// never fused, so that all instruction sets round alike.
#include "surfaces/tile_triangles.h"

// Vectors of these sets have no size at compile time, so they cannot be members.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// Also compiles the scalar code on every machine, so that it is tested.
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "surfaces/tile_triangles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hl {
namespace HWY_NAMESPACE {
namespace {

namespace tiles {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, TileBall::kCells>;
using V = hn::Vec<D>;
using Mask = hn::Mask<D>;
constexpr D kFloats;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);

struct V3 {
  V x, y, z;
};

HWY_INLINE V3 sum(const V3& a, const V3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE V3 apart(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE V dot(const V3& a, const V3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V3 same(const std::array<float, 3>& v) {
  return {hn::Set(kFloats, v[0]), hn::Set(kFloats, v[1]), hn::Set(kFloats, v[2])};
}

struct Pixels {
  V depth;
  V3 place;
};

HWY_INLINE Pixels read(const TileBall& ball, const float* depths, std::size_t column, std::size_t row) {
  const V depth = hn::LoadU(kFloats, depths + column);
  const auto axis = [&](std::size_t k) HWY_ATTR {
    const V way = hn::Add(hn::LoadU(kFloats, &ball.column[k][column]), hn::Set(kFloats, ball.row[k][row]));
    return hn::Sub(hn::Mul(depth, way), hn::Set(kFloats, ball.middle[k]));
  };
  return {depth, {axis(0), axis(1), axis(2)}};
}

// Along a direction n of any length the ball reaches |n| beyond its middle, which goes from -n . half to n . half.
// Returns where it is not separated from the triangle all the way; `earliest` rises to when it may come to it.
HWY_INLINE Mask meets(const V3& n, const V3& a, const V3& b, const V3& c, const V3& half, V& earliest) {
  const V x = dot(n, a), y = dot(n, b), z = dot(n, c), square = dot(n, n), along = dot(n, half);
  const V ahead = hn::Min(hn::Min(x, y), z), behind = hn::Neg(hn::Max(hn::Max(x, y), z));
  const Mask known = hn::Gt(square, hn::Set(kFloats, 1e-30F));  // below it the square has lost its digits
  const V apart = hn::Sub(hn::Max(ahead, behind), hn::Sqrt(square));
  const V toward = hn::IfThenElse(hn::Lt(ahead, behind), hn::Neg(along), along);
  const Mask comes = hn::And(known, hn::Gt(toward, hn::Zero(kFloats)));
  earliest = hn::IfThenElse(comes, hn::Max(earliest, hn::Div(apart, toward)), earliest);
  return hn::Not(hn::And(known, hn::Gt(apart, hn::Abs(along))));
}

// As DepthCamera::joins().
HWY_INLINE Mask joins(V a, V b, V c, V join) {
  const V least = hn::Min(hn::Min(a, b), c), most = hn::Max(hn::Max(a, b), c);
  return hn::And(hn::Gt(least, hn::Zero(kFloats)), hn::Le(hn::Sub(most, least), hn::Mul(join, least)));
}

HWY_INLINE unsigned bitsOf(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kFloats, mask, bytes);
  return bytes[0];
}

// The triangles of some cells, in a row of the tile; returns their bits.
HWY_INLINE unsigned touched(const Pixels& a, const Pixels& b, const Pixels& c, const TileBall& ball, float* earliest) {
  Mask left = joins(a.depth, b.depth, c.depth, hn::Set(kFloats, ball.join));
  if (hn::AllFalse(kFloats, left)) return 0;
  V time = hn::Set(kFloats, -1);
  const V3 half = same(ball.half), middle = sum(sum(a.place, b.place), c.place);
  left = hn::And(left, meets(middle, a.place, b.place, c.place, half, time));
  if (hn::AllFalse(kFloats, left)) return 0;
  const V3 normal = cross(apart(b.place, a.place), apart(c.place, a.place));
  left = hn::And(left, meets(normal, a.place, b.place, c.place, half, time));
  hn::StoreU(time, kFloats, earliest);
  return bitsOf(left);
}

}  // namespace tiles

void touchedFor(const TileBall& ball, const float* first, std::size_t stride, std::size_t rows, TileTouches& touches) {
  constexpr std::size_t kCells = TileBall::kCells;
  for (std::size_t row = 0; row < rows; ++row) {
    const float *const depths = first + row * stride, *const below = depths + stride;
    float* const earliest = touches.earliest[row].data();
    unsigned bits = 0;
    for (std::size_t i = 0; i < kCells; i += tiles::kLanes) {
      const tiles::Pixels a = tiles::read(ball, depths, i, row), d = tiles::read(ball, below, i + 1, row + 1);
      bits |= tiles::touched(a, tiles::read(ball, depths, i + 1, row), d, ball, earliest + i) << i;
      bits |= tiles::touched(a, tiles::read(ball, below, i, row + 1), d, ball, earliest + kCells + i) << (i + kCells);
    }
    touches.bits[row] = static_cast<std::uint16_t>(bits);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hl
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hl {

HWY_EXPORT(touchedFor);

void touchedTriangles(const TileBall& ball, const float* first, std::size_t stride, std::size_t rows,
                      TileTouches& touches) {
  HWY_DYNAMIC_DISPATCH(touchedFor)(ball, first, stride, rows, touches);
}

}  // namespace hl
#endif  // HWY_ONCE
