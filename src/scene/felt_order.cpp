#include "scene/felt_order.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace hl {

namespace {

// -1 if a is larger: the harder or rougher one comes first.
template <typename Value>
int larger(const Value& a, const Value& b) {
  return a > b ? -1 : a < b ? 1 : 0;
}

const Material& materialOf(const FeltPrimitive& one) {
  return one.instance.surfaces->materials[one.instance.shape->materialOf(one.element)];
}

int compareNumbers(const Material& a, const Material& b) {
  const auto numbers = [](const Material& m) {
    std::array<double, kNumbers + 1> all{};
    for (std::size_t i = 0; i < kNumbers; ++i) all[i] = m.*kMaterialNumbers[i];
    all[kNumbers] = m.smooth ? 1 : 0;
    return all;
  };
  return larger(numbers(a), numbers(b));
}

int compareImages(const Texture& a, const Texture& b) {
  const auto shape = [](const Texture& t) { return std::tuple(t.width, t.height, t.wrap, t.filter); };
  if (&a == &b) return 0;
  const int shapes = larger(shape(a), shape(b));
  return shapes != 0 ? shapes : larger(a.texels, b.texels);
}

int compareTextures(const FeltPrimitive& a, const FeltPrimitive& b) {
  for (std::size_t i = 0; i < kQuantities; ++i) {
    const TextureUse &one = materialOf(a).textures[i], &other = materialOf(b).textures[i];
    const auto numbers = [](const TextureUse& use) { return std::tuple(use.used(), use.high, use.low); };
    int order = larger(numbers(one), numbers(other));
    if (order == 0 && one.used())
      order = compareImages(*a.instance.surfaces->textures[one.texture], *b.instance.surfaces->textures[other.texture]);
    if (order != 0) return order;
  }
  return 0;
}

// Compares the vertex data, in the order of the sorted vertices.
int compareCorners(const FeltPrimitive& a, const FeltPrimitive& b) {
  if (a.primitive.kind != PrimitiveKind::kTriangle) return 0;
  const auto corners = [](const FeltPrimitive& one) {
    const Shape& shape = *one.instance.shape;
    std::array<double, 15> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
      if (shape.hasNormals()) std::copy_n(shape.cornerNormal(one.element, one.primitive, i).data(), 3, &numbers[5 * i]);
      if (!shape.hasTexcoords()) continue;
      const Vec2 texcoord = shape.cornerTexcoord(one.primitive.source, one.primitive.order[i]);
      std::copy_n(texcoord.data(), 2, &numbers[5 * i + 3]);
    }
    return numbers;
  };
  return larger(corners(a), corners(b));
}

}  // namespace

void toOneFrame(const Instance& of_a, const Instance& of_b, std::int64_t time_ns, Primitive& a, Primitive& b) {
  if (&of_a == &of_b) return;
  const Pose pose_a = of_a.poses().at(time_ns), pose_b = of_b.poses().at(time_ns);
  for (std::size_t i = 0; i < 3; ++i) {
    a.vertex[i] = pose_a.toWorld(a.vertex[i]);
    b.vertex[i] = pose_b.toWorld(b.vertex[i]);
  }
}

int compareFelt(const FeltPrimitive& a, const FeltPrimitive& b) {
  const int numbers = compareNumbers(materialOf(a), materialOf(b));
  if (numbers != 0) return numbers;
  const int textures = compareTextures(a, b);
  return textures != 0 ? textures : compareCorners(a, b);
}

}  // namespace hl
