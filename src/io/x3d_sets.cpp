#include "io/x3d_sets.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

namespace hl {

namespace {

using Indices = std::vector<long>;
constexpr long kEnd = -1;  // of a face or line

template <typename Number>
std::vector<Number> listOf(const std::string& text) {
  std::vector<Number> list;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    Number value{};
    const auto [next, error] = std::from_chars(at, end, value);
    if (error == std::errc()) list.push_back(value);
    at = next == at ? at + 1 : next;
  }
  return list;
}

std::string textOf(const Indices& indices) {
  std::string text;
  for (const long index : indices) text += std::to_string(index) + ' ';
  return text;
}

// What cuts a row of corners into faces or lines, which it appends with their ends.
using Cut = void (*)(const Indices& row, Indices& out);

void cutFace(const Indices& row, Indices& out) {
  if (row.empty()) return;
  out.insert(out.end(), row.begin(), row.end());
  out.push_back(kEnd);
}

template <std::size_t kCorners>
void cutEqual(const Indices& row, Indices& out) {
  for (std::size_t i = 0; i + kCorners <= row.size(); i += kCorners) {
    out.insert(out.end(), row.begin() + static_cast<std::ptrdiff_t>(i),
               row.begin() + static_cast<std::ptrdiff_t>(i + kCorners));
    out.push_back(kEnd);
  }
}

void cutStrip(const Indices& row, Indices& out) {
  for (std::size_t i = 0; i + 3 <= row.size(); ++i) {
    const std::size_t odd = i % 2;  // every other triangle turns the other way
    out.insert(out.end(), {row[i + odd], row[i + 1 - odd], row[i + 2], kEnd});
  }
}

void cutFan(const Indices& row, Indices& out) {
  for (std::size_t i = 1; i + 2 <= row.size(); ++i) out.insert(out.end(), {row[0], row[i], row[i + 1], kEnd});
}

void cutLines(const Indices& row, Indices& out) {
  for (std::size_t i = 0; i + 2 <= row.size(); ++i) out.insert(out.end(), {row[i], row[i + 1], kEnd});
}

// Rows that are ended by a negative number.
Indices cutIndexed(const Indices& indices, Cut cut) {
  Indices out, row;
  for (const long index : indices) {
    if (index >= 0) row.push_back(index);
    if (index < 0) cut(std::exchange(row, {}), out);
  }
  cut(row, out);
  return out;
}

// How a set is said in other words.
struct Rewriting {
  const char* as;
  const char* indices;  // the field of them; none: the corners are numbered by themselves
  const char* counts;   // then: how many each has; none: it is one row
  Cut cut;
};
const std::map<std::string_view, Rewriting> kSets{
    {"IndexedFaceSet", {"IndexedFaceSet", "coordIndex", nullptr, cutFace}},
    {"IndexedLineSet", {"IndexedLineSet", "coordIndex", nullptr, cutLines}},
    {"IndexedQuadSet", {"IndexedFaceSet", "index", nullptr, cutEqual<4>}},
    {"IndexedTriangleSet", {"IndexedFaceSet", "index", nullptr, cutEqual<3>}},
    {"IndexedTriangleStripSet", {"IndexedFaceSet", "index", nullptr, cutStrip}},
    {"IndexedTriangleFanSet", {"IndexedFaceSet", "index", nullptr, cutFan}},
    {"LineSet", {"IndexedLineSet", nullptr, "vertexCount", cutLines}},
    {"QuadSet", {"IndexedFaceSet", nullptr, nullptr, cutEqual<4>}},
    {"TriangleSet", {"IndexedFaceSet", nullptr, nullptr, cutEqual<3>}},
    {"TriangleStripSet", {"IndexedFaceSet", nullptr, "stripCount", cutStrip}},
    {"TriangleFanSet", {"IndexedFaceSet", nullptr, "fanCount", cutFan}}};

// Rows of so many corners each, of the corners 0, 1, ...; nothing, where there are not so many.
std::optional<Indices> cutCounted(const Indices& counts, std::size_t corners, Cut cut) {
  Indices out;
  long next = 0;
  for (const long count : counts) {
    if (count < 0 || count > static_cast<long>(corners) - next) return std::nullopt;
    Indices row(static_cast<std::size_t>(count));
    for (long& corner : row) corner = next++;
    cut(row, out);
  }
  return out;
}

std::string fieldOf(const X3dTree& set, const char* name) { return x3dField(set, name).value_or(""); }

// Colours of whole lines and strips have no place where these are cut; assimp knows no indices of those of faces.
void plainColours(X3dTree& set, const Rewriting& how) {
  const bool per_face = fieldOf(set, "colorPerVertex") == "false";
  const Indices indices = listOf<long>(fieldOf(set, "colorIndex"));
  const bool keeps_faces = how.cut == cutFace || how.cut == cutEqual<4>;
  if (per_face && (!keeps_faces || !indices.empty())) {
    set.erase("Color");
    set.erase("ColorRGBA");
    eraseX3dField(set, "colorIndex");
  } else if (!indices.empty()) {
    setX3dField(set, "colorIndex", textOf(cutIndexed(indices, how.cut)));
  }
}

}  // namespace

std::vector<double> x3dNumbers(const std::string& text) { return listOf<double>(text); }

bool isX3dSet(const std::string& type) { return kSets.contains(type); }

std::string plainSet(const std::string& type, X3dTree& set, std::size_t points, std::vector<std::string>& warnings) {
  const Rewriting& how = kSets.at(type);
  std::optional<Indices> indices;
  if (how.indices != nullptr) {
    indices = cutIndexed(listOf<long>(fieldOf(set, how.indices)), how.cut);
  } else {
    const Indices one_row{static_cast<long>(points)};
    indices = cutCounted(how.counts != nullptr ? listOf<long>(fieldOf(set, how.counts)) : one_row, points, how.cut);
    if (!indices) warnings.push_back(type + " is left out: it counts more corners than it has points");
  }
  if (!indices || indices->empty()) return "";
  setX3dField(set, "coordIndex", textOf(*indices));
  plainColours(set, how);
  for (const char* field : {"normalIndex", "texCoordIndex"}) {
    const Indices list = listOf<long>(fieldOf(set, field));
    const bool per_face = *field == 'n' && fieldOf(set, "normalPerVertex") == "false";
    if (!list.empty() && !per_face) setX3dField(set, field, textOf(cutIndexed(list, how.cut)));
  }
  return how.as;
}

void makeCone(X3dTree& cone) {
  constexpr int kSides = 64;
  const auto number = [&](const char* name, double otherwise) {
    const std::vector<double> numbers = x3dNumbers(fieldOf(cone, name));
    return numbers.empty() ? otherwise : numbers[0];
  };
  const double radius = number("bottomRadius", 1), top = number("height", 2) / 2;
  std::string points = fmt::format("0 {} 0", top);
  Indices faces, bottom;
  for (int i = 0; i < kSides; ++i) {
    const double turn = 2 * std::numbers::pi * i / kSides;
    points += fmt::format(" {} {} {}", radius * std::sin(turn), -top, radius * std::cos(turn));
    if (fieldOf(cone, "side") != "false") faces.insert(faces.end(), {0, i + 1, (i + 1) % kSides + 1, kEnd});
    bottom.insert(bottom.begin(), i + 1);
  }
  bottom.push_back(kEnd);
  if (fieldOf(cone, "bottom") != "false") faces.insert(faces.end(), bottom.begin(), bottom.end());
  for (const char* field : {"bottomRadius", "height", "side", "bottom"}) eraseX3dField(cone, field);
  setX3dField(cone, "coordIndex", textOf(faces));
  X3dTree coordinates;
  setX3dField(coordinates, "point", points);
  cone.push_back({"Coordinate", coordinates});
}

}  // namespace hl
