#include "io/x3d_plain.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "base/direction.h"
#include "io/x3d_document.h"
#include "io/x3d_prototypes.h"

namespace hl {

namespace {

// Nodes of which assimp knows only others that place the same.
const std::map<std::string_view, const char*> kSameAs{{"Anchor", "Group"},
                                                      {"Billboard", "Group"},
                                                      {"Collision", "Group"},
                                                      {"LOD", "Group"},
                                                      {"Layer", "Group"},
                                                      {"LayerSet", "Group"},
                                                      {"CADLayer", "Group"},
                                                      {"CADAssembly", "Group"},
                                                      {"CADFace", "Group"},
                                                      {"CADPart", "Transform"},
                                                      {"EspduTransform", "Transform"},
                                                      {"HAnimHumanoid", "Transform"},
                                                      {"HAnimJoint", "Transform"},
                                                      {"HAnimSite", "Transform"},
                                                      {"HAnimSegment", "Group"},
                                                      {"CoordinateDouble", "Coordinate"},
                                                      {"PhysicalMaterial", "Material"},
                                                      {"UnlitMaterial", "Material"}};
// Fields of these, whose nodes are shown by another field too, or never.
const std::map<std::string_view, std::set<std::string_view>> kNotShown{
    {"Collision", {"proxy"}}, {"HAnimHumanoid", {"joints", "segments", "sites", "viewpoints"}}};
// What a Shape may have.
const std::set<std::string_view> kShapes{
    "Appearance",      "Arc2D",          "ArcClose2D",         "Box",
    "Circle2D",        "Cone",           "Cylinder",           "Disk2D",
    "ElevationGrid",   "Extrusion",      "IndexedFaceSet",     "IndexedLineSet",
    "LineSet",         "PointSet",       "IndexedTriangleSet", "IndexedTriangleFanSet",
    "Polyline2D",      "Polypoint2D",    "Rectangle2D",        "IndexedTriangleStripSet",
    "Sphere",          "TriangleFanSet", "TriangleSet",        "TriangleSet2D",
    "MetadataBoolean", "MetadataDouble", "MetadataFloat",      "MetadataInteger",
    "MetadataSet",     "MetadataString"};

// What an Appearance may have. Nothing else of it is shown.
const std::set<std::string_view> kLooks{"Material", "PhysicalMaterial", "UnlitMaterial", "ImageTexture",
                                        "TextureTransform"};

using Indices = std::vector<long>;
constexpr long kEnd = -1;  // of a face or line

// The numbers of a text; commas are blanks.
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

void cutQuads(const Indices& row, Indices& out) {
  for (std::size_t i = 0; i + 4 <= row.size(); i += 4)
    out.insert(out.end(), {row[i], row[i + 1], row[i + 2], row[i + 3], kEnd});
}

void cutStrip(const Indices& row, Indices& out) {
  for (std::size_t i = 0; i + 3 <= row.size(); ++i) {
    const std::size_t odd = i % 2;  // every other triangle turns the other way
    out.insert(out.end(), {row[i + odd], row[i + 1 - odd], row[i + 2], kEnd});
  }
}

void cutLines(const Indices& row, Indices& out) {
  for (std::size_t i = 0; i + 2 <= row.size(); ++i) out.insert(out.end(), {row[i], row[i + 1], kEnd});
}

// Rows that are ended by kEnd.
Indices cutIndexed(const Indices& indices, Cut cut) {
  Indices out, row;
  for (const long index : indices) {
    if (index >= 0) row.push_back(index);
    if (index < 0) cut(std::exchange(row, {}), out);
  }
  cut(row, out);
  return out;
}

// Rows of so many corners each, of the corners 0, 1, ...
Indices cutCounted(const Indices& counts, std::size_t corners, Cut cut) {
  Indices out;
  std::size_t next = 0;
  for (const long count : counts) {
    Indices row;
    for (long i = 0; i < count && next < corners; ++i) row.push_back(static_cast<long>(next++));
    cut(row, out);
  }
  return out;
}

// How a set of faces or lines is said in other words.
struct Rewriting {
  const char* as;
  const char* indices;  // the field of them; none: the corners are numbered by themselves
  const char* counts;   // then: how many each has; none: it is one row
  Cut cut;
};
const std::map<std::string_view, Rewriting> kSets{
    {"IndexedQuadSet", {"IndexedFaceSet", "index", nullptr, cutQuads}},
    {"QuadSet", {"IndexedFaceSet", nullptr, nullptr, cutQuads}},
    {"TriangleStripSet", {"IndexedFaceSet", nullptr, "stripCount", cutStrip}},
    {"IndexedLineSet", {"IndexedLineSet", "coordIndex", nullptr, cutLines}},
    {"LineSet", {"IndexedLineSet", nullptr, "vertexCount", cutLines}}};

bool isListOfNumbers(const std::string& text) {
  return text.find_first_not_of("0123456789+-.eE, \t\r\n") == std::string::npos;
}

void makeUnitAxis(X3dNode& node, const char* field) {
  const auto text = x3dField(node, field);
  if (!text) return;
  const auto list = listOf<double>(*text);
  if (list.size() != 4) return;
  const std::optional<Vec3> axis = unitOf({list[0], list[1], list[2]});
  setX3dField(node.second, field,
              axis ? fmt::format("{} {} {} {}", axis->x(), axis->y(), axis->z(), list[3]) : "0 0 1 0");
}

class Simplifier {
 public:
  Simplifier(X3dTree& tree, std::vector<std::string>& warnings) : warnings_(warnings) { addNames(tree); }

  void simplify(X3dTree& parent, std::string_view type) {
    X3dTree simple(parent.data());
    for (X3dNode& child : parent) {
      if (!isX3dElement(child)) simple.push_back(child);
      if (isX3dElement(child) && keeps(type, child)) simple.push_back(simplified(child));
    }
    parent.swap(simple);
  }

 private:
  void addNames(const X3dTree& parent) {
    for (const X3dNode& child : parent) {
      if (const auto name = x3dField(child, "DEF")) coordinates_.emplace(*name, x3dField(child, "point").value_or(""));
      addNames(child.second);
    }
  }

  bool keeps(std::string_view type, const X3dNode& child) {
    const auto hidden = kNotShown.find(type);
    if (hidden != kNotShown.end() && hidden->second.contains(x3dField(child, "containerField").value_or("")))
      return false;
    if (type == "Appearance" && !kLooks.contains(child.first)) return false;
    const bool in_shape = type == "Shape" && !kShapes.contains(child.first) && !kSets.contains(child.first);
    if (!in_shape && child.first != "Inline") return true;
    if (left_out_.insert(child.first).second) warnings_.push_back(child.first + " is left out");
    return false;
  }

  X3dNode simplified(X3dNode& node) {
    if (node.first == "LOD") keepFirst(node.second);
    plainNumbers(node.second);
    makeUnitAxis(node, "rotation");
    makeUnitAxis(node, "scaleOrientation");
    if (const auto colour = x3dField(node, "baseColor")) setX3dField(node.second, "diffuseColor", *colour);
    const auto set = kSets.find(node.first);
    if (set != kSets.end()) rewrite(node, set->second);
    const auto same = kSameAs.find(node.first);
    const std::string type = set != kSets.end() ? set->second.as : same != kSameAs.end() ? same->second : node.first;
    simplify(node.second, node.first);
    return {type, std::move(node.second)};
  }

  // The finest level comes first.
  static void keepFirst(X3dTree& levels) {
    bool first = true;
    for (auto level = levels.begin(); level != levels.end();) {
      const bool stays = !isX3dElement(*level) || std::exchange(first, false);
      level = stays ? std::next(level) : levels.erase(level);
    }
  }

  static void plainNumbers(X3dTree& node) {
    for (X3dNode& fields : node) {
      if (fields.first != "<xmlattr>") continue;
      for (auto& [name, value] : fields.second) {
        if (isListOfNumbers(value.data())) std::replace(value.data().begin(), value.data().end(), ',', ' ');
      }
    }
  }

  // Colours of whole lines and strips have no place where these are cut.
  void rewrite(X3dNode& node, const Rewriting& how) const {
    if (x3dField(node, "USE")) return;
    const auto list = [&](const char* field) { return listOf<long>(x3dField(node, field).value_or("")); };
    Indices indices;
    if (how.indices != nullptr) {
      indices = cutIndexed(list(how.indices), how.cut);
    } else {
      const std::size_t corners = cornersOf(node);
      const Indices one_row{static_cast<long>(corners)};
      indices = cutCounted(how.counts != nullptr ? list(how.counts) : one_row, corners, how.cut);
    }
    if (x3dField(node, "colorPerVertex") == "false" && how.cut != cutQuads) {
      node.second.erase("Color");
      node.second.erase("ColorRGBA");
      setX3dField(node.second, "colorIndex", "");
    } else if (x3dField(node, "colorIndex")) {
      setX3dField(node.second, "colorIndex", textOf(cutIndexed(list("colorIndex"), how.cut)));
    }
    setX3dField(node.second, "coordIndex", textOf(indices));
  }

  std::size_t cornersOf(const X3dNode& set) const {
    for (const X3dNode& child : set.second) {
      if (!child.first.starts_with("Coordinate")) continue;
      const auto used = coordinates_.find(x3dField(child, "USE").value_or(""));
      const std::string points = used != coordinates_.end() ? used->second : x3dField(child, "point").value_or("");
      return listOf<double>(points).size() / 3;
    }
    return 0;
  }

  std::vector<std::string>& warnings_;
  std::map<std::string, std::string> coordinates_;  // points by the DEF of their node
  std::set<std::string> left_out_;
};

}  // namespace

std::string plainX3d(const std::string& text, std::vector<std::string>& warnings) {
  X3dTree tree = parseX3d(text);
  expandPrototypes(tree, warnings);
  Simplifier(tree, warnings).simplify(tree, "");
  return textOfX3d(tree);
}

}  // namespace hl
