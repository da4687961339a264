// X3D document: the nodes of an X3D file in its XML encoding (ISO/IEC 19776-1), their fields, and what DEF and USE
// name.
#pragma once

#include <boost/property_tree/ptree.hpp>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "scene/texture.h"

namespace hl {

using X3dTree = boost::property_tree::ptree;
/// The type of a node, and what is in it: its fields and its children.
using X3dNode = X3dTree::value_type;
using X3dNodes = std::set<const X3dNode*>;

inline constexpr std::size_t kMaxX3dBytes = std::size_t{256} << 20;  ///< of a text; its tree takes several times that
inline constexpr int kDeepestX3d = 500;        ///< elements: what walks a tree takes some of the stack for each
inline constexpr double kFarthestX3d_m = 1e6;  ///< of places that are read, along each axis

/// The nodes of a text. Throws hl::Error, one line, for what is no XML, too large or nested too deep. There are no
/// entities but those of XML.
X3dTree parseX3d(const std::string& text);
std::string textOfX3d(const X3dTree& tree);

/// The child of a node that has its fields.
inline constexpr const char* kX3dFields = "<xmlattr>";

/// A field as it is written, or nothing.
std::optional<std::string> x3dField(const X3dNode& node, const std::string& name);
std::optional<std::string> x3dField(const X3dTree& node, const std::string& name);
void eraseX3dField(X3dTree& node, const std::string& name);
/// Sets a field of the node whose fields and children these are.
void setX3dField(X3dTree& node, const std::string& name, const std::string& value);
/// Adds `scope` to the names that the node defines or uses, so that they are its own.
void addX3dScope(X3dNode& node, const std::string& scope);
/// Whether it is a node: not the fields of one, nor text.
bool isX3dElement(const X3dNode& node);
/// For warnings: "RigidBody 'door'".
std::string nameOfX3d(const X3dNode& node);
/// For people: its DEF, or its type.
std::string labelOfX3d(const X3dNode& node);
bool isX3d(const X3dNode& node, std::initializer_list<std::string_view> types);

class X3dDocument {
 public:
  /// Throws as parseX3d().
  explicit X3dDocument(const std::string& text);
  X3dDocument(const X3dDocument&) = delete;
  X3dDocument& operator=(const X3dDocument&) = delete;

  const X3dTree& tree() const { return tree_; }
  /// Null: there is none of this name.
  const X3dNode* named(const std::string& name) const;
  /// All of a type that are no USE, in their order.
  std::vector<const X3dNode*> all(std::string_view type) const;
  /// The node itself, or the one that it USEs; null where that is none of its type.
  const X3dNode* definitionOf(const X3dNode& node) const;

  /// The text of a document with nothing but this node.
  std::string textOf(const X3dNode& node) const;
  /// The text of this one without what moves bodies, and without these definitions and each USE of them.
  std::string textWithout(const X3dNodes& taken) const;

 private:
  void addNames(const X3dTree& parent);

  X3dTree tree_;
  std::map<std::string, const X3dNode*> names_;
};

/// Fields of a node by their types. One that makes no sense gives a warning, and its default.
class X3dFields {
 public:
  X3dFields(const X3dNode& node, std::vector<std::string>& warnings) : node_(node), warnings_(warnings) {}

  bool has(const char* name) const { return x3dField(node_, name).has_value(); }
  void warn(const std::string& what) const { warnings_.push_back(nameOfX3d(node_) + ": " + what); }
  bool flag(const char* name, bool otherwise) const;
  double number(const char* name, double otherwise, double least, double most) const;
  Vec2 pair(const char* name, const Vec2& otherwise, double least, double most) const;
  Vec3 vec(const char* name, const Vec3& otherwise, double most) const;
  /// An axis, of any length, and an angle in radians.
  Mat3 rotation(const char* name) const;

 private:
  // Empty: the field is not given, or is not so many numbers between `least` and `most`.
  std::vector<double> numbers(const char* name, std::size_t count, double least, double most) const;

  const X3dNode& node_;
  std::vector<std::string>& warnings_;
};

}  // namespace hl
