#include "io/x3d_document.h"

#include <algorithm>
#include <array>
#include <boost/property_tree/xml_parser.hpp>
#include <charconv>
#include <sstream>

#include "base/direction.h"
#include "base/error.h"

namespace hl {

namespace {

// What a browser of X3D never shows, and what says which event goes where.
constexpr std::array<std::string_view, 8> kMovers{"RigidBodyCollection", "RigidBody",      "CollisionCollection",
                                                  "CollisionSensor",     "CollisionSpace", "CollidableOffset",
                                                  "CollidableShape",     "ROUTE"};

// Past the end of what begins at `at` and ends with `end`.
std::size_t behind(const std::string& text, std::size_t at, std::string_view end) {
  const std::size_t found = text.find(end, at);
  return found == std::string::npos ? text.size() : found + end.size();
}

// Past the '>' of a tag; '>' may stand within quotes.
std::size_t behindTag(const std::string& text, std::size_t at) {
  for (char quote = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at + 1;
    }
  }
  return at;
}

// Before it is parsed, as the parser is recursive.
void checkDepth(const std::string& text) {
  int depth = 0;
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::string_view rest = std::string_view(text).substr(at);
    if (rest.starts_with("<!--")) {
      at = behind(text, at, "-->");
    } else if (rest.starts_with("<![CDATA[")) {
      at = behind(text, at, "]]>");
    } else if (rest.starts_with("<?")) {
      at = behind(text, at, "?>");
    } else if (rest.starts_with("</")) {
      --depth;
      at = behind(text, at, ">");
    } else {
      at = behindTag(text, at);
      const bool closed = at >= 2 && text[at - 2] == '/';
      if (rest[1 < rest.size() ? 1 : 0] != '!' && !closed && ++depth > kDeepestX3d)
        throw Error("its nodes are nested too deep");
    }
  }
}

// The definitions that are left come to the first of their USEs, where their own place is no longer there.
class Restorer {
 public:
  explicit Restorer(const X3dDocument& document) : document_(document) {}

  void restore(X3dTree& parent, int depth = 0) {
    if (depth > 2 * kDeepestX3d) throw Error("its nodes are nested too deep");
    for (X3dNode& child : parent) {
      if (child.first == kX3dFields) continue;
      if (const auto use = x3dField(child, "USE"); use && !known_.contains(*use)) {
        if (const X3dNode* definition = document_.definitionOf(child)) child.second = definition->second;
      }
      if (const auto name = x3dField(child, "DEF")) known_.insert(*name);
      restore(child.second, depth + 1);
    }
  }

 private:
  const X3dDocument& document_;
  std::set<std::string> known_;  // so each is copied once
};

void removeTaken(const X3dDocument& document, const X3dTree& from, const X3dNodes& taken, X3dTree& to) {
  for (const X3dNode& child : from) {
    if (std::find(kMovers.begin(), kMovers.end(), child.first) != kMovers.end() ||
        taken.contains(document.definitionOf(child)))
      continue;
    X3dTree& copy = to.push_back({child.first, X3dTree(child.second.data())})->second;
    removeTaken(document, child.second, taken, copy);
  }
}

// What a prototype declares is none of the scene.
void collectNodes(const X3dTree& parent, std::string_view type, std::vector<const X3dNode*>& found) {
  for (const X3dNode& child : parent) {
    if (child.first == "ProtoDeclare") continue;
    if (child.first == type && !x3dField(child, "USE")) found.push_back(&child);
    collectNodes(child.second, type, found);
  }
}

}  // namespace

X3dTree parseX3d(const std::string& text) {
  namespace xml = boost::property_tree::xml_parser;
  if (text.size() > kMaxX3dBytes) throw Error("is larger than 256 MB, which is too much for X3D");
  checkDepth(text);
  X3dTree tree;
  std::istringstream in(text);
  try {
    xml::read_xml(in, tree, xml::no_comments | xml::trim_whitespace);
  } catch (const xml::xml_parser_error& error) {
    throw Error("is no XML: line " + std::to_string(error.line()) + ": " + error.message());
  }
  return tree;
}

std::string textOfX3d(const X3dTree& tree) {
  std::ostringstream out;
  boost::property_tree::xml_parser::write_xml(out, tree);
  return out.str();
}

void setX3dField(X3dTree& node, const std::string& name, const std::string& value) {
  if (node.count(kX3dFields) == 0) node.push_front({kX3dFields, X3dTree()});
  X3dTree& fields = node.find(kX3dFields)->second;
  const auto field = fields.find(name);
  if (field != fields.not_found()) {
    field->second.data() = value;
  } else {
    fields.push_back({name, X3dTree(value)});
  }
}

std::optional<std::string> x3dField(const X3dTree& node, const std::string& name) {
  const auto attributes = node.find(kX3dFields);
  if (attributes == node.not_found()) return std::nullopt;
  const auto field = attributes->second.find(name);
  if (field == attributes->second.not_found()) return std::nullopt;
  return field->second.data();
}

std::optional<std::string> x3dField(const X3dNode& node, const std::string& name) {
  return x3dField(node.second, name);
}

void eraseX3dField(X3dTree& node, const std::string& name) {
  const auto attributes = node.find(kX3dFields);
  if (attributes != node.not_found()) attributes->second.erase(name);
}

void addX3dScope(X3dNode& node, const std::string& scope) {
  for (const char* name : {"DEF", "USE"}) {
    if (const auto text = x3dField(node, name)) setX3dField(node.second, name, *text + scope);
  }
}

bool isX3dElement(const X3dNode& node) { return !node.first.empty() && node.first.front() != '<'; }

std::string nameOfX3d(const X3dNode& node) {
  const auto name = x3dField(node, x3dField(node, "DEF") ? "DEF" : "USE");
  return name ? node.first + " '" + *name + "'" : node.first;
}

std::string labelOfX3d(const X3dNode& node) { return x3dField(node, "DEF").value_or(node.first); }

bool isX3d(const X3dNode& node, std::initializer_list<std::string_view> types) {
  return std::find(types.begin(), types.end(), node.first) != types.end();
}

X3dDocument::X3dDocument(const std::string& text) : tree_(parseX3d(text)) { addNames(tree_); }

// Of two with one name the first counts.
void X3dDocument::addNames(const X3dTree& parent) {
  for (const X3dNode& child : parent) {
    if (child.first == kX3dFields || child.first == "ProtoDeclare") continue;
    if (const auto name = x3dField(child, "DEF")) names_.emplace(*name, &child);
    addNames(child.second);
  }
}

const X3dNode* X3dDocument::named(const std::string& name) const {
  const auto found = names_.find(name);
  return found == names_.end() ? nullptr : found->second;
}

const X3dNode* X3dDocument::definitionOf(const X3dNode& node) const {
  const auto use = x3dField(node, "USE");
  if (!use) return &node;
  const X3dNode* definition = named(*use);
  return definition != nullptr && definition->first == node.first ? definition : nullptr;
}

std::string X3dDocument::textOf(const X3dNode& node) const {
  X3dTree scene;
  scene.push_back(node);
  Restorer(*this).restore(scene);
  X3dTree document;
  document.put("X3D.<xmlattr>.version", "3.3");
  document.put_child("X3D.Scene", scene);
  return textOfX3d(document);
}

std::string X3dDocument::textWithout(const X3dNodes& taken) const {
  X3dTree rest;
  removeTaken(*this, tree_, taken, rest);
  Restorer(*this).restore(rest);
  return textOfX3d(rest);
}

std::vector<const X3dNode*> X3dDocument::all(std::string_view type) const {
  std::vector<const X3dNode*> found;
  collectNodes(tree_, type, found);
  return found;
}

std::vector<double> X3dFields::numbers(const char* name, std::size_t count, double least, double most) const {
  const auto text = x3dField(node_, name);
  if (!text) return {};
  std::vector<double> list;
  const char* at = text->data();
  const char* const end = at + text->size();
  const auto skip = [&] { at = std::find_if(at, end, [](char c) { return c > ' ' && c != ',' && c != '+'; }); };
  for (skip(); at != end && list.size() <= count; skip()) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !(value >= least && value <= most)) break;
    list.push_back(value);
    at = next;
  }
  if (at == end && list.size() == count) return list;
  warn(std::string(name) + " is left out: it makes no sense here");
  return {};
}

bool X3dFields::flag(const char* name, bool otherwise) const {
  const auto text = x3dField(node_, name);
  if (text == "true" || text == "TRUE") return true;
  if (text == "false" || text == "FALSE") return false;
  if (text) warn(std::string(name) + " is left out: it must be true or false");
  return otherwise;
}

double X3dFields::number(const char* name, double otherwise, double least, double most) const {
  const std::vector<double> list = numbers(name, 1, least, most);
  return list.empty() ? otherwise : list[0];
}

Vec2 X3dFields::pair(const char* name, const Vec2& otherwise, double least, double most) const {
  const std::vector<double> list = numbers(name, 2, least, most);
  return list.empty() ? otherwise : Vec2(list[0], list[1]);
}

Vec3 X3dFields::vec(const char* name, const Vec3& otherwise, double most) const {
  const std::vector<double> list = numbers(name, 3, -most, most);
  return list.empty() ? otherwise : Vec3(list[0], list[1], list[2]);
}

Mat3 X3dFields::rotation(const char* name) const {
  constexpr double kMax = 1e6;
  const std::vector<double> list = numbers(name, 4, -kMax, kMax);
  if (list.empty()) return Mat3::Identity();
  const std::optional<Vec3> axis = unitOf({list[0], list[1], list[2]});
  return axis ? Eigen::AngleAxisd(list[3], *axis).toRotationMatrix() : Mat3(Mat3::Identity());
}

}  // namespace hl
