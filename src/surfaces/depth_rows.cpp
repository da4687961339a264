// Compiled once for each instruction set (foreach_target includes this file again). Multiplications and additions are
// never fused, so that all instruction sets round alike.
#include "surfaces/depth_rows.h"

#include <algorithm>
#include <limits>

// Vectors of these sets have no size at compile time.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// Also compiles the scalar code on every machine, so that it is tested.
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "surfaces/depth_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hl {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float kFarthest = std::numeric_limits<float>::infinity();

// Calls part(tag, i) for whole vectors, and then for single numbers.
template <typename Number, typename Part>
HWY_INLINE void inParts(std::size_t count, const Part& part) {
  const hn::ScalableTag<Number> vector;
  const hn::CappedTag<Number, 1> single;
  std::size_t i = 0;
  for (; i + hn::Lanes(vector) <= count; i += hn::Lanes(vector)) part(vector, i);
  for (; i < count; ++i) part(single, i);
}

#if HWY_HAVE_FLOAT64
template <typename D>
HWY_INLINE hn::Vec<D> loaded(D d, const float* from) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), from));
}
template <typename D, typename Sample>
HWY_INLINE hn::Vec<D> loaded(D d, const Sample* from) {
  return hn::PromoteTo(d, hn::PromoteTo(hn::Rebind<std::int32_t, D>(), hn::LoadU(hn::Rebind<Sample, D>(), from)));
}

template <typename Sample>
HWY_INLINE void readAll(const Sample* samples, std::size_t count, double scale_m, double missing, float* depths) {
  inParts<double>(count, [&](auto d, std::size_t i) HWY_ATTR {
    const auto sample = loaded(d, samples + i), depth = hn::Mul(sample, hn::Set(d, scale_m));
    const auto most = hn::Set(d, std::numeric_limits<float>::max());
    const auto there =
        hn::And(hn::And(hn::Gt(depth, hn::Zero(d)), hn::Le(depth, most)), hn::Not(hn::Eq(sample, hn::Set(d, missing))));
    const hn::Rebind<float, decltype(d)> small;
    hn::StoreU(hn::DemoteTo(small, hn::IfThenElseZero(there, depth)), small, depths + i);
  });
}
#else  // vectors of doubles are missing on WebAssembly
template <typename Sample>
void readAll(const Sample* samples, std::size_t count, double scale_m, double missing, float* depths) {
  for (std::size_t i = 0; i < count; ++i) {
    const double sample = samples[i], depth = sample * scale_m;
    const bool there = depth > 0 && depth <= double{std::numeric_limits<float>::max()} && sample != missing;
    depths[i] = there ? static_cast<float>(depth) : 0;
  }
}
#endif

// As DepthCamera::joins().
template <typename D>
HWY_INLINE hn::Mask<D> joined(D d, hn::Vec<D> least, hn::Vec<D> most, hn::Vec<D> join) {
  return hn::And(hn::Gt(least, hn::Zero(d)), hn::Le(hn::Sub(most, least), hn::Mul(join, least)));
}

// The cells of a band that are bounded together.
struct CellBounds {
  HWY_ALIGN float low[kMaxSide * 8], high[kMaxSide * 8];
};

HWY_INLINE std::size_t addRow(const float* row, const float* below, std::size_t cells, float join, CellBounds& bounds) {
  std::size_t triangles = 0;
  inParts<float>(cells, [&](auto d, std::size_t i) HWY_ATTR {
    const auto a = hn::LoadU(d, row + i), b = hn::LoadU(d, row + i + 1);
    const auto c = hn::LoadU(d, below + i), e = hn::LoadU(d, below + i + 1);
    const auto least = hn::Min(a, e), most = hn::Max(a, e), part = hn::Set(d, join);
    auto low = hn::LoadU(d, bounds.low + i), high = hn::LoadU(d, bounds.high + i);
    const auto add = [&](auto corner) HWY_ATTR {
      const auto nearest = hn::Min(least, corner), farthest = hn::Max(most, corner);
      const auto there = joined(d, nearest, farthest, part);
      low = hn::Min(low, hn::IfThenElse(there, nearest, hn::Set(d, kFarthest)));
      high = hn::Max(high, hn::IfThenElse(there, farthest, hn::Set(d, -kFarthest)));
      triangles += hn::CountTrue(d, there);
    };
    add(b);
    add(c);
    hn::StoreU(low, d, bounds.low + i);
    hn::StoreU(high, d, bounds.high + i);
  });
  return triangles;
}

void readFor(const Samples& samples, std::size_t first, std::size_t count, double scale_m, float* depths) {
  const double missing = samples.missing().value_or(std::numeric_limits<double>::quiet_NaN());
  switch (samples.kind()) {
    case SampleKind::kInt16:
      return readAll(static_cast<const std::int16_t*>(samples.data()) + first, count, scale_m, missing, depths);
    case SampleKind::kUint16:
      return readAll(static_cast<const std::uint16_t*>(samples.data()) + first, count, scale_m, missing, depths);
    case SampleKind::kFloat32:
      return readAll(static_cast<const float*>(samples.data()) + first, count, scale_m, static_cast<float>(missing),
                     depths);
  }
}

void followFor(const FollowedPixels& pixels, const FollowRule& rule) {
  inParts<float>(pixels.count, [&](auto d, std::size_t i) HWY_ATTR {
    const hn::Rebind<std::int32_t, decltype(d)> whole;
    const hn::Rebind<std::uint8_t, decltype(d)> small;
    const auto now = hn::LoadU(d, pixels.now + i), before = hn::LoadU(d, pixels.before + i);
    const auto held = hn::ConvertTo(d, hn::PromoteTo(whole, hn::LoadU(small, pixels.held_before + i)));
    const auto same = joined(d, hn::Min(now, before), hn::Max(now, before), hn::Set(d, rule.join));
    const auto moved = hn::Add(before, hn::Mul(hn::Set(d, rule.share), hn::Sub(now, before)));
    const auto lost = hn::And(hn::Eq(now, hn::Zero(d)), hn::Gt(before, hn::Zero(d)));
    const auto stays = hn::And(lost, hn::Lt(held, hn::Set(d, rule.most_held)));
    const auto depth = hn::IfThenElse(same, moved, hn::IfThenElse(stays, before, now));
    hn::StoreU(depth, d, pixels.depths + i);
    const auto longer = hn::IfThenElseZero(stays, hn::Add(held, hn::Set(d, 1)));
    hn::StoreU(hn::DemoteTo(small, hn::ConvertTo(whole, longer)), small, pixels.held + i);
  });
}

std::size_t boundFor(const CellBand& band, float join, std::size_t side, DepthRange* tiles) {
  CellBounds bounds;
  const std::size_t cells = band.pixels - 1, together = 8 * side;
  std::size_t triangles = 0;
  for (std::size_t begin = 0; begin < cells; begin += together) {
    const std::size_t end = std::min(begin + together, cells);
    std::fill_n(bounds.low, together, kFarthest);
    std::fill_n(bounds.high, together, -kFarthest);
    for (std::size_t j = 0; j < band.rows; ++j) {
      const float* const row = band.first + j * band.pixels + begin;
      triangles += addRow(row, row + band.pixels, end - begin, join, bounds);
    }
    for (std::size_t first = 0; begin + first < end; first += side, ++tiles)
      *tiles = {*std::min_element(bounds.low + first, bounds.low + first + side),
                *std::max_element(bounds.high + first, bounds.high + first + side)};
  }
  return triangles;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hl
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hl {

HWY_EXPORT(readFor);
HWY_EXPORT(followFor);
HWY_EXPORT(boundFor);

void readDepths(const Samples& samples, std::size_t first, std::size_t count, double scale_m, float* depths) {
  HWY_DYNAMIC_DISPATCH(readFor)(samples, first, count, scale_m, depths);
}
void followDepths(const FollowedPixels& pixels, const FollowRule& rule) {
  HWY_DYNAMIC_DISPATCH(followFor)(pixels, rule);
}
std::size_t boundCells(const CellBand& band, float join, std::size_t side, DepthRange* tiles) {
  return HWY_DYNAMIC_DISPATCH(boundFor)(band, join, side, tiles);
}

}  // namespace hl
#endif  // HWY_ONCE
