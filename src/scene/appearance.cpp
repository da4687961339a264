#include "scene/appearance.h"

#include <algorithm>

namespace hl {

namespace {

bool isGrey(const Rgb& colour) { return colour[0] == colour[1] && colour[1] == colour[2]; }

// Objects that show the same file have it once.
std::uint32_t pictureIn(Appearance& whole, const Picture& picture) {
  const auto is_same = [&](const Picture& one) { return one.file == picture.file && one.wrap == picture.wrap; };
  const auto found = std::find_if(whole.pictures.begin(), whole.pictures.end(), is_same);
  const auto number = static_cast<std::uint32_t>(found - whole.pictures.begin());
  if (number == whole.pictures.size()) whole.pictures.push_back(picture);
  return number;
}

std::uint16_t paintIn(Appearance& whole, const Paint& paint) {
  const auto is_same = [&](const Paint& one) { return one.colour == paint.colour && one.picture == paint.picture; };
  const auto found = std::find_if(whole.paints.begin(), whole.paints.end(), is_same);
  const auto number = static_cast<std::size_t>(found - whole.paints.begin());
  if (number == whole.paints.size() && number < Appearance::kMaxPaints) whole.paints.push_back(paint);
  return static_cast<std::uint16_t>(std::min(number, whole.paints.size() - 1));
}

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
  std::vector<std::uint16_t> numbers;  // in the whole, of each paint of the part
  for (Paint paint : part.paints) {
    if (paint.picture) paint.picture = pictureIn(whole, part.pictures[*paint.picture]);
    numbers.push_back(paintIn(whole, paint));
  }
  if (part.triangle_paints.empty()) {
    whole.triangle_paints.resize(triangles + part_triangles, paintIn(whole, Paint{}));
    return;
  }
  for (const std::uint16_t paint : part.triangle_paints) whole.triangle_paints.push_back(numbers[paint]);
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
