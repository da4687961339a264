#include "geometry/primitives.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace hl {

namespace {

void extend(Box& box, const std::array<Vec3, 3>& corners) {
  for (const Vec3& corner : corners) box.extend(corner);
}

}  // namespace

Primitives::Primitives(const MeshView& mesh) : mesh_(mesh), size_(mesh.elements()) {
  constexpr std::size_t kRun = 4096;
  assert(size_ <= std::numeric_limits<std::uint32_t>::max());
  std::vector<Run> runs((size_ + kRun - 1) / kRun);
  oneapi::tbb::parallel_for(std::size_t{0}, runs.size(),
                            [&](std::size_t i) { runs[i] = look(i * kRun, std::min(size_, (i + 1) * kRun)); });
  leaveOut(runs);
  for (const Run& run : runs) bounds_.extend(run.bounds);
}

Primitives::Primitives(const MeshView& mesh, std::vector<std::uint32_t> elements)
    : mesh_(mesh), kept_(std::move(elements)), size_(kept_.size()), shrunken_(true) {
  for (std::size_t i = 0; i < size_; ++i) extend(bounds_, corners(i));
}

Primitives::Run Primitives::look(std::size_t begin, std::size_t end) const {
  Run run;
  for (std::size_t i = begin; i < end; ++i) {
    const Element made_from = element(i);
    if (valid(made_from)) {
      extend(run.bounds, corners(made_from));
    } else {
      run.refused.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return run;
}

// Lists the elements that are kept, if some are refused.
void Primitives::leaveOut(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    for (const std::uint32_t number : run.refused) {
      const PrimitiveKind kind = element(number).kind;
      ++(kind == PrimitiveKind::kTriangle  ? refused_.triangles
         : kind == PrimitiveKind::kSegment ? refused_.segments
                                           : refused_.points);
    }
  }
  if (refused_.sum() == 0) return;
  std::vector<std::uint32_t> kept;
  kept.reserve(size_ - refused_.sum());
  std::uint32_t next = 0;
  const auto keep_up_to = [&](std::uint32_t end) {
    for (; next < end; ++next) kept.push_back(next);
  };
  for (const Run& run : runs) {
    for (const std::uint32_t number : run.refused) {
      keep_up_to(number);
      next = number + 1;
    }
  }
  keep_up_to(static_cast<std::uint32_t>(size_));
  size_ = kept.size();
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

PrimitiveKind Primitives::kind(std::size_t i) const {
  if (shrunken_) return (*this)[i].kind;
  return ready_.empty() ? element(i).kind : ready_[i].kind;
}

PrimitiveKind Primitives::elementKind(std::size_t i) const { return element(i).kind; }

std::uint32_t Primitives::source(std::size_t i) const { return ready_.empty() ? element(i).source : ready_[i].source; }

Primitive Primitives::operator[](std::size_t i) const {
  if (!ready_.empty()) return ready_[i];
  const Element made_from = element(i);
  const auto v = corners(made_from);
  if (shrunken_) return shrunkenOf(made_from.kind, v, made_from.source);
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

Box Primitives::bounds() const {
  Box bounds = bounds_;
  for (const Primitive& primitive : ready_) extend(bounds, primitive.vertex);
  return bounds;
}

}  // namespace hl
