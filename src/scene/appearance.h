// Appearance: the colours and pictures that a file gives a mesh. Pages show them; they are never felt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/rgb.h"
#include "scene/texture.h"

namespace hl {

/// A PNG or JPEG file as it is: pages decode it. Its lowest row is v = 0, as that of a texture.
struct Picture {
  std::shared_ptr<const std::string> file;
  Wrap wrap = Wrap::kRepeat;
};

/// What some of the triangles look like.
struct Paint {
  Rgb colour = kWhite;                     ///< multiplies the picture and the colours of vertices
  std::optional<std::uint32_t> picture{};  ///< index into Appearance::pictures
};

/// Of one mesh; all lists are empty where its file has none.
struct Appearance {
  static constexpr std::size_t kMaxPaints = 0xffff;

  std::vector<Picture> pictures;
  std::vector<Paint> paints;
  std::vector<std::uint16_t> triangle_paints;  ///< index into `paints` for each triangle, or empty
  std::vector<Rgb> vertex_colours;             ///< one for each position, or empty

  bool empty() const { return triangle_paints.empty() && vertex_colours.empty(); }
  std::size_t bytes() const;
  /// Whether the lists fit to a mesh of so many triangles and vertices, and to each other.
  bool fits(std::size_t triangles, std::size_t vertices) const;
};

/// Appends the appearance of a mesh of so many triangles and vertices, which is appended to one of `triangles` and
/// `vertices`. Where only one of the two has paints or colours, the other becomes white.
void appendAppearance(Appearance& whole, std::size_t triangles, std::size_t vertices, const Appearance& part,
                      std::size_t part_triangles, std::size_t part_vertices);

/// None, if all that it says is one grey, as exporters write it where nobody has chosen a colour.
void dropPlainAppearance(Appearance& appearance);

}  // namespace hl
