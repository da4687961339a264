#include "scene/mesh_motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace hl {

namespace {

const WideBvh* treeOf(const Shape& shape) { return dynamic_cast<const WideBvh*>(shape.index.get()); }

bool allWithinReach(const std::array<Vec3, 3>& corners) {
  return std::all_of(corners.begin(), corners.end(), [](const Vec3& corner) { return withinReach(corner); });
}

// The elements that are a primitive in either shape, except those with vertices beyond reach.
std::vector<std::uint32_t> elementsOf(const Shape& from, const Shape& to) {
  const auto numbers = [](const Shape& shape) {
    std::vector<std::uint32_t> result(shape.primitives.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = shape.primitives.elementNumber(i);
    return result;
  };
  const std::vector<std::uint32_t> a = numbers(from), b = numbers(to);
  std::vector<std::uint32_t> all;
  all.reserve(std::max(a.size(), b.size()));
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  const Primitives shrunken(viewOf(to.model), all);
  std::vector<std::uint32_t> result;
  result.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (allWithinReach(shrunken.corners(i))) result.push_back(all[i]);
  }
  return result;
}

// Memory of the lists in elementsOf(), for each primitive of either shape.
constexpr std::size_t kBytesInLists = 6 * sizeof(std::uint32_t);

// `from`, with each vertex that is beyond reach replaced by that of `to`.
Model within(const Model& from, const Model& to) {
  Model model = from;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    if (!withinReach(model.positions[i])) model.positions[i] = to.positions[i];
  }
  return model;
}

}  // namespace

MeshTransition::MeshTransition(std::shared_ptr<const Shape> from, std::shared_ptr<const Shape> to,
                               std::int64_t begin_ns, std::int64_t end_ns, const MemoryBudget& memory)
    : given_from_(from),
      given_to_(to),
      from_(std::move(from)),
      to_(std::move(to)),
      begin_ns_(begin_ns),
      end_ns_(end_ns) {
  if (treeOf(*to_) == nullptr || !from_->primitives.numberedAs(to_->primitives)) {
    MemoryShare lists(memory);
    lists.take(kBytesInLists * (from_->primitives.size() + to_->primitives.size()));
    const std::vector<std::uint32_t> elements = elementsOf(*from_, *to_);
    to_ = makeCounted(memory, bytesToMake(to_->model), [&] { return shapeOfElements(to_->model, elements, nullptr); });
    from_ = makeCounted(memory, bytesToMake(from_->model),
                        [&] { return shapeOfElements(within(from_->model, to_->model), elements, treeOf(*to_)); });
  } else if (treeOf(*from_) == nullptr || !treeOf(*from_)->isTreeOf(*treeOf(*to_))) {
    from_ = makeCounted(memory, bytesToMake(from_->model), [&] { return withTree(*from_, *treeOf(*to_)); });
  }
  from_tree_ = treeOf(*from_);
  to_tree_ = treeOf(*to_);
}

double MeshTransition::part(std::int64_t time_ns) const {
  if (time_ns <= begin_ns_) return 0;
  if (time_ns >= end_ns_) return 1;
  return static_cast<double>(time_ns - begin_ns_) / static_cast<double>(end_ns_ - begin_ns_);
}

std::array<Vec3, 3> MeshTransition::corners(ElementId primitive, double part) const {
  const std::array<std::uint32_t, 3> vertex = verticesOf(*to_, primitive);
  std::array<Vec3, 3> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = (1 - part) * from_->model.positions[vertex[i]] + part * to_->model.positions[vertex[i]];
  return result;
}

Primitive MeshTransition::primitive(ElementId primitive, double part) const {
  return shrunkenOf(to_->primitives.elementKind(primitive), corners(primitive, part),
                    to_->primitives.source(primitive));
}

double MeshTransition::length_m(ElementId primitive) const {
  const auto begin = corners(primitive, 0), end = corners(primitive, 1);
  double most2 = 0;
  for (std::size_t i = 0; i < 3; ++i) most2 = std::max(most2, (end[i] - begin[i]).squaredNorm());
  return std::sqrt(most2);
}

// If the last transition ends after `begin_ns`, the new one is shortened by that time, at most to half. So delays do
// not add up when frames come a little early.
MeshMotion MeshMotion::then(const std::shared_ptr<const Shape>& to, std::int64_t begin_ns, std::int64_t end_ns,
                            const MemoryBudget& memory) const {
  const bool begun = last_.begin_ns() <= begin_ns;
  const std::int64_t next_ns = begun ? std::max(begin_ns, last_.end_ns()) : last_.begin_ns();
  const std::int64_t least_end_ns = next_ns + (end_ns - begin_ns + 1) / 2;
  MeshTransition next(begun ? last_.given_to() : last_.given_from(), to, next_ns, std::max(end_ns, least_end_ns),
                      memory);
  return {begun ? std::optional<MeshTransition>(last_) : earlier_, std::move(next)};
}

}  // namespace hl
