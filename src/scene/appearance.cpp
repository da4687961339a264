#include "scene/appearance.h"

#include <algorithm>

namespace hl {

namespace {

constexpr Rgb kWhite{255, 255, 255};

bool isGrey(const Rgb& colour) { return colour[0] == colour[1] && colour[1] == colour[2]; }

}  // namespace

std::size_t Appearance::bytes() const {
  std::size_t bytes = paints.capacity() * sizeof(Paint) + triangle_paints.capacity() * sizeof(std::uint16_t) +
                      vertex_colours.capacity() * sizeof(Rgb);
  for (const Picture& picture : pictures) bytes += sizeof(Picture) + picture.file->size();
  return bytes;
}

bool Appearance::fits(std::size_t triangles, std::size_t vertices) const {
  const auto has_picture = [&](const Paint& paint) { return !paint.picture || *paint.picture < pictures.size(); };
  return (triangle_paints.empty() || triangle_paints.size() == triangles) &&
         (vertex_colours.empty() || vertex_colours.size() == vertices) && paints.size() <= kMaxPaints &&
         std::all_of(paints.begin(), paints.end(), has_picture) &&
         std::all_of(triangle_paints.begin(), triangle_paints.end(), [&](auto paint) { return paint < paints.size(); });
}

void appendAppearance(Appearance& whole, std::size_t triangles, std::size_t vertices, const Appearance& part,
                      std::size_t part_triangles, std::size_t part_vertices) {
  if (!whole.vertex_colours.empty() || !part.vertex_colours.empty()) {
    whole.vertex_colours.resize(vertices, kWhite);
    whole.vertex_colours.insert(whole.vertex_colours.end(), part.vertex_colours.begin(), part.vertex_colours.end());
    whole.vertex_colours.resize(vertices + part_vertices, kWhite);
  }
  if (whole.triangle_paints.empty() && part.triangle_paints.empty()) return;
  if (whole.triangle_paints.empty()) {
    whole.paints = {Paint{}};
    whole.triangle_paints.assign(triangles, 0);
  }
  const std::vector<Paint> plain{Paint{}};
  const bool painted = !part.triangle_paints.empty();
  const std::size_t first = whole.paints.size(), first_picture = whole.pictures.size();
  for (Paint paint : painted ? part.paints : plain) {
    if (paint.picture) *paint.picture += static_cast<std::uint32_t>(first_picture);
    if (whole.paints.size() < Appearance::kMaxPaints) whole.paints.push_back(paint);
  }
  whole.pictures.insert(whole.pictures.end(), part.pictures.begin(), part.pictures.end());
  for (std::size_t i = 0; i < part_triangles; ++i) {
    const std::size_t paint = first + (painted ? part.triangle_paints[i] : 0);
    whole.triangle_paints.push_back(static_cast<std::uint16_t>(std::min(paint, whole.paints.size() - 1)));
  }
}

void dropPlainAppearance(Appearance& appearance) {
  const auto& vertices = appearance.vertex_colours;
  const auto as_first = [&](const Rgb& colour) { return colour == vertices.front(); };
  if (!vertices.empty() && isGrey(vertices.front()) && std::all_of(vertices.begin(), vertices.end(), as_first))
    appearance.vertex_colours.clear();
  if (!appearance.vertex_colours.empty() || appearance.triangle_paints.empty()) return;
  const Paint& first = appearance.paints[appearance.triangle_paints.front()];
  const bool plain =
      std::all_of(appearance.triangle_paints.begin(), appearance.triangle_paints.end(), [&](std::uint16_t number) {
        const Paint& paint = appearance.paints[number];
        return !paint.picture && paint.colour == first.colour;
      });
  if (plain && isGrey(first.colour)) appearance = {};
}

}  // namespace hl
