#include "io/x3d_plain.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "base/direction.h"
#include "base/error.h"
#include "io/x3d_document.h"
#include "io/x3d_extrusion.h"
#include "io/x3d_sets.h"

namespace hl {

namespace {

constexpr std::size_t kMostShown = 1'000'000;

// Nodes with children, as those of these that assimp knows and place the same.
const std::map<std::string_view, const char*> kGroups{{"Group", "Group"},
                                                      {"StaticGroup", "Group"},
                                                      {"Transform", "Transform"},
                                                      {"Switch", "Group"},
                                                      {"LOD", "Group"},
                                                      {"Anchor", "Group"},
                                                      {"Billboard", "Group"},
                                                      {"Collision", "Group"},
                                                      {"Layer", "Group"},
                                                      {"LayerSet", "Group"},
                                                      {"CADLayer", "Group"},
                                                      {"CADAssembly", "Group"},
                                                      {"CADFace", "Group"},
                                                      {"CADPart", "Transform"},
                                                      {"EspduTransform", "Transform"},
                                                      {"HAnimSegment", "Group"},
                                                      {"HAnimHumanoid", "Transform"},
                                                      {"HAnimJoint", "Transform"},
                                                      {"HAnimSite", "Transform"}};
// Other nodes by the names that assimp knows.
const std::map<std::string_view, const char*> kSameAs{{"CoordinateDouble", "Coordinate"},
                                                      {"Cone", "IndexedFaceSet"},
                                                      {"Extrusion", "IndexedFaceSet"},
                                                      {"PhysicalMaterial", "Material"},
                                                      {"UnlitMaterial", "Material"}};
// Fields of these, whose nodes are shown by another field too, or never.
const std::map<std::string_view, std::set<std::string_view>> kNotShown{
    {"Collision", {"proxy"}}, {"HAnimHumanoid", {"joints", "segments", "sites", "viewpoints"}}};
// What a Shape may have, beside sets of faces and lines.
const std::set<std::string_view> kShapes{"Appearance",    "Arc2D",       "ArcClose2D", "Box",
                                         "Circle2D",      "Cone",        "Cylinder",   "Disk2D",
                                         "ElevationGrid", "Extrusion",   "PointSet",   "Polyline2D",
                                         "Polypoint2D",   "Rectangle2D", "Sphere",     "TriangleSet2D"};
// What an Appearance may have. Nothing else of it is shown.
const std::set<std::string_view> kLooks{"Material", "PhysicalMaterial", "UnlitMaterial", "ImageTexture",
                                        "TextureTransform"};

bool isListOfNumbers(const std::string& text) {
  return text.find_first_not_of("0123456789+-.eE, \t\r\n") == std::string::npos;
}

void makeUnitAxis(X3dTree& node, const char* field) {
  const std::vector<double> list = x3dNumbers(x3dField(node, field).value_or(""));
  if (list.size() != 4) return;
  const std::optional<Vec3> axis = unitOf({list[0], list[1], list[2]});
  setX3dField(node, field, axis ? fmt::format("{} {} {} {}", axis->x(), axis->y(), axis->z(), list[3]) : "0 0 1 0");
}

// The fields as assimp takes them: no commas, and axes of length 1.
void plainFields(X3dTree& node) {
  const auto fields = node.find(kX3dFields);
  if (fields == node.not_found()) return;
  for (auto& [name, value] : fields->second) {
    if (isListOfNumbers(value.data())) std::replace(value.data().begin(), value.data().end(), ',', ' ');
  }
  for (const char* field : {"rotation", "scaleOrientation"}) makeUnitAxis(node, field);
  if (const auto colour = x3dField(node, "baseColor")) setX3dField(node, "diffuseColor", *colour);
}

// Makes a tree out of a tree of X3D, which it does not change.
class Simplifier {
 public:
  Simplifier(const X3dTree& tree, std::vector<std::string>& warnings) : warnings_(warnings) { addNames(tree); }

  X3dTree simplified(const X3dTree& parent, std::string_view type) {
    X3dTree simple(parent.data());
    const long chosen = chosenOf(parent, type);
    long number = 0;
    for (const X3dNode& child : parent) {
      if (!isX3dElement(child)) simple.push_back(child);
      if (!isX3dElement(child) || child.first.starts_with("Metadata")) continue;
      if ((chosen == kAll || number++ == chosen) && keeps(type, child)) show(child, simple);
    }
    return simple;
  }

 private:
  static constexpr long kAll = -2;

  // Of two nodes of one name the first counts.
  void addNames(const X3dTree& parent) {
    for (const X3dNode& child : parent) {
      if (const auto name = x3dField(child, "DEF")) names_.emplace(*name, &child);
      addNames(child.second);
    }
  }

  // The number of the only child that is shown: of levels of detail the first, which is the finest.
  static long chosenOf(const X3dTree& parent, std::string_view type) {
    if (type == "LOD") return 0;
    if (type != "Switch") return kAll;
    const std::vector<double> choice = x3dNumbers(x3dField(parent, "whichChoice").value_or("-1"));
    return choice.empty() ? -1 : static_cast<long>(choice[0]);
  }

  bool keeps(std::string_view type, const X3dNode& child) {
    if (type == "Appearance" && !kLooks.contains(child.first)) return false;
    if (x3dField(child, "visible") == "false") return false;
    const auto hidden = kNotShown.find(type);
    if (hidden != kNotShown.end() && hidden->second.contains(x3dField(child, "containerField").value_or("")))
      return false;
    const bool in_shape = type == "Shape" && !kShapes.contains(child.first) && !isX3dSet(child.first);
    if (!in_shape && child.first != "Inline") return true;
    leaveOut(child.first);
    return false;
  }

  void leaveOut(const std::string& what) {
    if (left_out_.insert(what).second) warnings_.push_back(what + " is left out");
  }

  // A group that is used again is there again, as assimp loses what follows a USE of one; of what is in it the shapes
  // are used.
  void show(const X3dNode& child, X3dTree& out) {
    const X3dNode* const node = definitionOf(child);
    if (node == nullptr) return;
    if (++nodes_ > kMostShown) throw Error("its nodes are used more than a million times");
    const auto again = names_given_.find(node);
    if (again != names_given_.end()) {
      X3dTree& used = out.push_back({plainType(node->first), X3dTree()})->second;
      setX3dField(used, "USE", again->second);
      if (const auto field = x3dField(child, "containerField")) setX3dField(used, "containerField", *field);
    } else if (node != &child && !kGroups.contains(node->first) && !isSpatial(node->first)) {
      out.push_back(child);
    } else {
      addNode(*node, out);
    }
  }

  // The node itself, or what it USEs; null: that is not there, or it is a part of it.
  const X3dNode* definitionOf(const X3dNode& child) {
    const auto use = x3dField(child, "USE");
    if (!use) return &child;
    const auto found = names_.find(*use);
    if (found != names_.end() && !inside_.contains(found->second)) return found->second;
    leaveOut(found == names_.end() ? "USE of '" + *use + "', which is not there," : "USE of '" + *use + "' within it");
    return nullptr;
  }

  static bool isSpatial(const std::string& type) {
    return type == "Shape" || kShapes.contains(type) || kLooks.contains(type) || isX3dSet(type) ||
           type.starts_with("Coordinate") || type.starts_with("Normal") || type.starts_with("Color") ||
           type.starts_with("TextureCoordinate");
  }

  static std::string plainType(const std::string& type) {
    const auto group = kGroups.find(type), same = kSameAs.find(type);
    return group != kGroups.end() ? group->second : same != kSameAs.end() ? same->second : type;
  }

  void addNode(const X3dNode& node, X3dTree& out) {
    inside_.insert(&node);
    X3dTree simple = simplified(node.second, node.first);
    inside_.erase(&node);
    plainFields(simple);
    std::string type = plainType(node.first);
    if (node.first == "Cone") makeCone(simple);
    if (node.first == "Extrusion") makeExtrusion(simple);
    if (isX3dSet(node.first)) type = plainSet(node.first, simple, pointsOf(node.second), warnings_);
    if (type.empty() || (type == "IndexedFaceSet" && x3dField(simple, "coordIndex").value_or("").empty())) return;
    if (!kGroups.contains(node.first)) {
      giveName(node, simple);
    } else if (std::any_of(simple.begin(), simple.end(), isX3dElement)) {
      eraseX3dField(simple, "DEF");
    } else {
      return;  // assimp loses what follows a group of nothing
    }
    out.push_back({type, X3dTree()})->second.swap(simple);
  }

  // So that it can be used where its group is there again.
  void giveName(const X3dNode& node, X3dTree& simple) {
    auto name = x3dField(node, "DEF");
    if (name && names_.at(*name) != &node) name.reset();
    if (!name && node.first != "Shape") return;
    const std::string given = name.value_or("_shape" + std::to_string(names_given_.size()));
    names_given_.emplace(&node, given);
    setX3dField(simple, "DEF", given);
  }

  std::size_t pointsOf(const X3dTree& set) const {
    for (const X3dNode& child : set) {
      if (!child.first.starts_with("Coordinate")) continue;
      const auto used = names_.find(x3dField(child, "USE").value_or(""));
      const X3dNode& points = used != names_.end() ? *used->second : child;
      return x3dNumbers(x3dField(points, "point").value_or("")).size() / 3;
    }
    return 0;
  }

  std::vector<std::string>& warnings_;
  std::map<std::string, const X3dNode*> names_;
  std::map<const X3dNode*, std::string> names_given_;  // of what is there already
  std::set<const X3dNode*> inside_;                    // what is being simplified
  std::set<std::string> left_out_;
  std::size_t nodes_ = 0;
};

}  // namespace

std::string plainX3d(const std::string& text, std::vector<std::string>& warnings) {
  X3dTree tree = parseX3d(text);
  return textOfX3d(Simplifier(tree, warnings).simplified(tree, ""));
}

}  // namespace hl
