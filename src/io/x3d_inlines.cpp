#include "io/x3d_inlines.h"

#include <fmt/core.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/plain_file.h"
#include "base/text.h"
#include "io/companion_file.h"
#include "io/text_words.h"
#include "io/x3d_document.h"
#include "io/x3d_prototypes.h"

namespace hl {

namespace {

constexpr int kMostInlines = 16;                 // one within the other
constexpr std::size_t kMostFiles = 10'000;       // each as often as it is inlined
constexpr std::size_t kMostInlined = 1'000'000;  // nodes
constexpr const char* kOnlyX3d = "it is no .x3d file";

// The texts of a list of strings: "a.x3d" "b.x3d"; one alone may lack the quotes.
std::vector<std::string> x3dStrings(const std::string& list) {
  if (list.find('"') == std::string::npos) return {std::string(trimmed(list))};
  std::vector<std::string> texts;
  for (std::size_t begin = list.find('"'); begin != std::string::npos;) {
    const std::size_t end = list.find('"', begin + 1);
    if (end == std::string::npos) break;
    texts.push_back(list.substr(begin + 1, end - begin - 1));
    begin = list.find('"', end + 1);
  }
  return texts;
}

void addToNames(X3dTree& parent, const std::string& scope) {
  for (X3dNode& child : parent) {
    if (!isX3dElement(child)) continue;
    addX3dScope(child, scope);
    addToNames(child.second, scope);
  }
}

std::size_t nodesIn(const X3dTree& parent) {
  std::size_t count = 0;
  for (const X3dNode& child : parent) {
    if (isX3dElement(child)) count += 1 + nodesIn(child.second);
  }
  return count;
}

const X3dTree* sceneOf(const X3dTree& tree) {
  const auto document = tree.find("X3D");
  if (document == tree.not_found()) return nullptr;
  const auto scene = document->second.find("Scene");
  return scene == document->second.not_found() ? nullptr : &scene->second;
}

class Inliner {
 public:
  Inliner(bool alone, std::vector<std::string>& warnings) : alone_(alone), warnings_(warnings) {}

  // In the document at `path`.
  void expand(X3dTree& parent, const std::string& path, int nested, int depth = 0) {
    if (depth > kDeepestX3d) throw Error("its nodes are nested too deep");
    X3dTree expanded(parent.data());
    for (X3dNode& child : parent) {
      if (child.first == "Inline") {
        expanded.push_back({"Group", groupOf(child, path, nested, depth + 1)});
        continue;
      }
      if (isX3dElement(child)) expand(child.second, path, nested, depth + 1);
      expanded.push_back({child.first, X3dTree()})->second.swap(child.second);
    }
    parent.swap(expanded);
  }

 private:
  X3dTree groupOf(const X3dNode& inlined, const std::string& path, int nested, int depth) {
    X3dTree group;
    for (const char* name : {"DEF", "USE", "visible", "containerField"}) {
      if (const auto text = x3dField(inlined, name)) setX3dField(group, name, *text);
    }
    if (x3dField(inlined, "USE") || x3dField(inlined, "load") == "false") return group;
    const std::optional<std::string> file = fileOf(x3dField(inlined, "url").value_or(""), path);
    if (!file) return group;
    if (nested >= kMostInlines || ++files_ > kMostFiles)
      throw Error("its Inline nodes are too many or nested too deep, or a file contains itself");
    X3dTree tree = parseX3d(withoutPrototypes(contentOf(*file).value_or(""), warnings_));
    expand(tree, *file, nested + 1, depth);
    if (const X3dTree* const scene = sceneOf(tree)) add(*scene, group);
    return group;
  }

  void add(const X3dTree& scene, X3dTree& group) {
    nodes_ += nodesIn(scene);
    if (nodes_ > kMostInlined) throw Error("its Inline nodes make more than a million nodes");
    X3dTree added;
    for (const X3dNode& node : scene) {
      if (isX3dElement(node)) added.push_back(node);
    }
    addToNames(added, fmt::format("_inline{}", ++scopes_));
    for (const X3dNode& node : added) group.push_back(node);
  }

  // The first of a list that is here; nothing: it is left out.
  std::optional<std::string> fileOf(const std::string& url, const std::string& path) {
    std::string why = "it names no file";
    for (const std::string& name : x3dStrings(url)) {
      try {
        if (alone_) throw Error("the file comes alone");
        const std::string found = companionPath(path, name);
        if (lowered(std::filesystem::path(found).extension().string()) != ".x3d") throw Error(kOnlyX3d);
        return found;
      } catch (const Error& error) {
        why = error.what();
      }
    }
    const std::string line = fmt::format("Inline '{}' is left out: {}", shown(url), why);
    if (said_.insert(line).second) warnings_.push_back(line);
    return {};
  }

  const bool alone_;
  std::vector<std::string>& warnings_;
  std::set<std::string> said_;
  std::size_t nodes_ = 0, files_ = 0, scopes_ = 0;
};

}  // namespace

std::string withInlines(const ModelFile& file, const std::string& text, std::vector<std::string>& warnings) {
  if (text.find("Inline") == std::string::npos) return text;
  X3dTree tree = parseX3d(text);
  Inliner(file.alone, warnings).expand(tree, file.path, 0);
  return textOfX3d(tree);
}

}  // namespace hl
