#include "geometry/primitives.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace hl {

Primitives::Primitives(const MeshView& mesh) : mesh_(mesh), size_(mesh.elements()) {
  assert(size_ <= std::numeric_limits<std::uint32_t>::max());
  std::vector<std::uint32_t> kept;
  const auto refuse = [&](std::size_t i, PrimitiveKind kind) {
    if (refused_.sum() == 0) {
      kept.reserve(size_ - 1);
      for (std::uint32_t before = 0; before < i; ++before) kept.push_back(before);
    }
    ++(kind == PrimitiveKind::kTriangle  ? refused_.triangles
       : kind == PrimitiveKind::kSegment ? refused_.segments
                                         : refused_.points);
  };
  for (std::size_t i = 0; i < size_; ++i) {
    const Element made_from = element(i);
    if (!valid(made_from)) {
      refuse(i, made_from.kind);
    } else if (refused_.sum() > 0) {
      kept.push_back(static_cast<std::uint32_t>(i));
    }
  }
  size_ -= refused_.sum();
  kept_ = std::move(kept);
}

bool Primitives::valid(const Element& element) const {
  const auto in_range = [&](std::uint32_t index) { return index < mesh_.positions.size(); };
  const auto all_in_range = [&](const auto& indices) { return std::all_of(indices.begin(), indices.end(), in_range); };
  switch (element.kind) {
    case PrimitiveKind::kTriangle: {
      if (!all_in_range(mesh_.triangles[element.source])) return false;
      const auto v = corners(element);
      return isTriangle(v[0], v[1], v[2]);
    }
    case PrimitiveKind::kSegment: {
      if (!all_in_range(mesh_.segments[element.source])) return false;
      const auto v = corners(element);
      return isSegment(v[0], v[1]);
    }
    case PrimitiveKind::kPoint:
      break;
  }
  return in_range(mesh_.points[element.source]) && withinReach(corners(element)[0]);
}

PrimitiveKind Primitives::kind(std::size_t i) const { return ready_.empty() ? element(i).kind : ready_[i].kind; }

std::uint32_t Primitives::source(std::size_t i) const { return ready_.empty() ? element(i).source : ready_[i].source; }

Primitive Primitives::operator[](std::size_t i) const {
  if (!ready_.empty()) return ready_[i];
  const Element made_from = element(i);
  const auto v = corners(made_from);
  switch (made_from.kind) {
    case PrimitiveKind::kTriangle:
      return triangleOf(v[0], v[1], v[2], made_from.source);
    case PrimitiveKind::kSegment:
      return segmentOf(v[0], v[1], made_from.source);
    case PrimitiveKind::kPoint:
      break;
  }
  return pointOf(v[0], made_from.source);
}

Box boundsOf(const Primitives& primitives) {
  constexpr std::size_t kGrain = 4096;
  using Range = oneapi::tbb::blocked_range<std::size_t>;
  const auto extend = [&](const Range& range, Box bounds) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const auto v = primitives.corners(i);
      bounds.min = bounds.min.cwiseMin(v[0].cwiseMin(v[1]).cwiseMin(v[2]));
      bounds.max = bounds.max.cwiseMax(v[0].cwiseMax(v[1]).cwiseMax(v[2]));
    }
    return bounds;
  };
  const auto both = [](const Box& a, const Box& b) { return Box{a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)}; };
  return oneapi::tbb::parallel_reduce(Range(0, primitives.size(), kGrain), Box(), extend, both);
}

}  // namespace hl
