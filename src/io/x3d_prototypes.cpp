#include "io/x3d_prototypes.h"

#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "io/x3d_document.h"

namespace hl {

namespace {

constexpr int kMostNested = 32;
constexpr std::size_t kMostNodes = 1'000'000;  // that instances make of their prototypes

// What a field of an instance is: text, or nodes.
struct FieldValue {
  std::optional<std::string> text;
  X3dTree nodes;
};
using FieldValues = std::map<std::string, FieldValue>;

void readFields(const X3dTree& from, std::string_view type, FieldValues& values) {
  for (const X3dNode& field : from) {
    const auto name = x3dField(field, "name");
    if (field.first != type || !name) continue;
    FieldValue& value = values[*name];
    value = {x3dField(field, "value"), {}};
    for (const X3dNode& node : field.second) {
      if (isX3dElement(node)) value.nodes.push_back(node);
    }
  }
}

struct Prototype {
  FieldValues defaults;
  X3dTree body;  // its first node alone: the others are not shown
};

Prototype prototypeOf(const X3dNode& declaration) {
  Prototype prototype;
  for (const X3dNode& child : declaration.second) {
    if (child.first == "ProtoInterface") readFields(child.second, "field", prototype.defaults);
    for (const X3dNode& node : child.second) {
      const bool in_body = child.first == "ProtoBody" && isX3dElement(node) && node.first != "ProtoDeclare";
      if (in_body && prototype.body.empty()) prototype.body.push_back(node);
    }
  }
  return prototype;
}

class Expansion {
 public:
  explicit Expansion(std::vector<std::string>& warnings) : warnings_(warnings) {}

  // Of two prototypes of one name the first counts.
  void collect(const X3dTree& parent) {
    for (const X3dNode& child : parent) {
      const auto name = x3dField(child, "name");
      if (child.first == "ProtoDeclare" && name) prototypes_.emplace(*name, prototypeOf(child));
      collect(child.second);
    }
  }

  void expand(X3dTree& parent, int nested) {
    X3dTree expanded(parent.data());
    for (X3dNode& child : parent) {
      if (child.first == "ProtoDeclare" || child.first == "ExternProtoDeclare") continue;
      if (child.first == "ProtoInstance") {
        for (const X3dNode& node : madeOf(child, nested)) expanded.push_back(node);
      } else {
        expand(child.second, nested);
        expanded.push_back(child);
      }
    }
    parent.swap(expanded);
  }

 private:
  // One node, or nothing.
  X3dTree madeOf(const X3dNode& instance, int nested) {
    if (const auto use = x3dField(instance, "USE")) return useOf(*use);
    const std::string name = x3dField(instance, "name").value_or("");
    const auto found = prototypes_.find(name);
    if (found == prototypes_.end()) {
      if (unknown_.insert(name).second)
        warnings_.push_back("ProtoInstance '" + name + "' is left out: it is not declared in this file");
      return {};
    }
    if (nested >= kMostNested) throw Error("its prototypes are nested too deep");
    FieldValues values = found->second.defaults;
    readFields(instance.second, "fieldValue", values);
    X3dTree made = found->second.body;
    const std::string scope = "_" + name + std::to_string(++instances_);
    for (X3dNode& node : made) connect(node, values, scope);
    const auto definition = x3dField(instance, "DEF");
    if (definition && !made.empty()) define(made.front(), *definition);
    expand(made, nested + 1);
    if (definition && !made.empty()) types_[*definition] = made.front().first;
    return made;
  }

  X3dTree useOf(const std::string& use) const {
    X3dTree made;
    const auto type = types_.find(use);
    if (type == types_.end()) return made;
    X3dTree node;
    setX3dField(node, "USE", use);
    made.push_back({type->second, node});
    return made;
  }

  static void define(X3dNode& node, const std::string& name) {
    if (const auto inner = x3dField(node, "DEF")) rename(node, *inner, name);
    setX3dField(node.second, "DEF", name);
  }

  // Gives the nodes the values of the fields that their IS names, and names that no other instance has.
  void connect(X3dNode& node, const FieldValues& values, const std::string& scope) {
    countNodes(1);
    addX3dScope(node, scope);
    X3dTree connected(node.second.data());
    for (X3dNode& child : node.second) {
      if (child.first == "IS") continue;
      if (isX3dElement(child)) connect(child, values, scope);
      connected.push_back(child);
    }
    for (const X3dNode& child : node.second) {
      if (child.first == "IS") connectFields(child.second, values, node.first, connected);
    }
    node.second.swap(connected);
  }

  // The fields of an instance within a prototype are nodes of their own.
  void connectFields(const X3dTree& is, const FieldValues& values, const std::string& type, X3dTree& node) {
    for (const X3dNode& connection : is) {
      const auto field = x3dField(connection, "nodeField");
      const auto value = values.find(x3dField(connection, "protoField").value_or(""));
      if (!field || value == values.end()) continue;
      countNodes(value->second.nodes.size());
      X3dTree given(value->second.nodes);
      if (type == "ProtoInstance") {
        setX3dField(given, "name", *field);
        if (value->second.text) setX3dField(given, "value", *value->second.text);
        node.push_back({"fieldValue", given});
        continue;
      }
      if (value->second.text) setX3dField(node, *field, *value->second.text);
      for (const X3dNode& one : given) node.push_back(one);
    }
  }

  void countNodes(std::size_t more) {
    nodes_ += more;
    if (nodes_ > kMostNodes) throw Error("its prototypes make more than a million nodes");
  }

  static void rename(X3dNode& node, const std::string& from, const std::string& to) {
    for (const char* name : {"DEF", "USE"}) {
      if (x3dField(node, name) == from) setX3dField(node.second, name, to);
    }
    for (X3dNode& child : node.second) {
      if (isX3dElement(child)) rename(child, from, to);
    }
  }

  std::vector<std::string>& warnings_;
  std::map<std::string, Prototype> prototypes_;
  std::map<std::string, std::string> types_;  // of the nodes that instances with a DEF have become
  std::set<std::string> unknown_;
  std::size_t instances_ = 0, nodes_ = 0;
};

}  // namespace

std::string withoutPrototypes(const std::string& text, std::vector<std::string>& warnings) {
  if (text.find("Proto") == std::string::npos) return text;
  X3dTree tree = parseX3d(text);
  Expansion expansion(warnings);
  expansion.collect(tree);
  expansion.expand(tree, 0);
  return textOfX3d(tree);
}

}  // namespace hl
