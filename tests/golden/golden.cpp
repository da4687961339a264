// The golden hash: one number over all bits that many ticks give, for each built-in scene and each effect. A change
// that moves one bit of one tick is seen here. The numbers are the same in every build, with every instruction set and,
// over their first part, with every hierarchy; a change that is meant is kept with --update, in the same commit.
#include <fmt/core.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "golden/cases.h"

namespace hl::golden {
namespace {

constexpr std::int64_t kFewTicks = 1000, kAllTicks = 100'000;
constexpr std::size_t kMaxWithoutHierarchy = 10'000;  // primitives: each is looked at in every step

struct Kept {
  std::uint64_t few = 0, all = 0;
};
using KeptByName = std::map<std::string, Kept>;

// A line each: hash after few ticks, hash after all, name.
KeptByName read(const std::string& path) {
  KeptByName kept;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    Kept one;
    std::string name;
    words >> std::hex >> one.few >> one.all >> std::ws;
    std::getline(words, name);
    if (!name.empty()) kept[name] = one;
  }
  return kept;
}

void write(const std::string& path, const KeptByName& kept) {
  std::ofstream file(path);
  for (const Case& one : cases()) {
    const Kept& hashes = kept.at(one.name);
    file << fmt::format("{:016x} {:016x} {}\n", hashes.few, hashes.all, one.name);
  }
}

// Compares, and reports what differs.
class Judge {
 public:
  explicit Judge(const KeptByName& kept) : kept_(kept) {}

  void expect(const std::string& name, bool few, std::uint64_t hash, const std::string& with) {
    const auto found = kept_.find(name);
    const bool same = found != kept_.end() && hash == (few ? found->second.few : found->second.all);
    if (!same) fmt::print("DIFFERS: {} after {} ticks, {}\n", name, few ? kFewTicks : kAllTicks, with);
    same_ = same_ && same;
    ++compared_;
  }
  bool same() const { return same_; }
  int compared() const { return compared_; }

 private:
  const KeptByName& kept_;
  bool same_ = true;
  int compared_ = 0;
};

void compareHierarchies(Judge& judge) {
  for (const Case& one : cases()) {
    for (const HierarchyKind hierarchy : {HierarchyKind::kSpheres, HierarchyKind::kNone}) {
      const bool slow = hierarchy == HierarchyKind::kNone && elementsOf(one) > kMaxWithoutHierarchy;
      if (slow) continue;
      judge.expect(one.name, true, hashesOf(one, hierarchy, {kFewTicks}).front(),
                   std::string("hierarchy ") + nameOf(hierarchy));
    }
  }
}

// Of this machine, and the one without vectors.
void compareInstructionSets(Judge& judge) {
  for (std::int64_t rest = hwy::SupportedTargets() | HWY_SCALAR; rest != 0; rest &= rest - 1) {
    const std::int64_t target = rest & -rest;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    for (const Case& one : cases()) {
      judge.expect(one.name, true, hashesOf(one, HierarchyKind::kBvh, {kFewTicks}).front(),
                   std::string("instruction set ") + hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

KeptByName hashAll() {
  KeptByName found;
  for (const Case& one : cases()) {
    const auto hashes = hashesOf(one, HierarchyKind::kBvh, {kFewTicks, kAllTicks});
    found[one.name] = {hashes[0], hashes[1]};
  }
  return found;
}

int compare(const std::string& path, bool few_only) {
  const KeptByName kept = read(path);
  Judge judge(kept);
  if (!few_only) {
    for (const auto& [name, hashes] : hashAll()) judge.expect(name, false, hashes.all, "this build");
  }
  compareInstructionSets(judge);
  compareHierarchies(judge);
  fmt::print("{} hashes compared: {}\n", judge.compared(), judge.same() ? "all as kept" : "not all as kept");
  return judge.same() ? 0 : 1;
}

}  // namespace
}  // namespace hl::golden

int main(int argc, char** argv) {
  CLI::App app("Compares the bits of many ticks with kept hashes.");
  std::string path = HL_GOLDEN_HASHES;
  bool update = false, few_only = false;
  app.add_option("--hashes", path, "the kept ones")->capture_default_str();
  app.add_flag("--update", update, "write the hashes of this build instead of comparing");
  app.add_flag("--few", few_only, "only the hashes after the first 1000 ticks");
  CLI11_PARSE(app, argc, argv);
  if (!update) return hl::golden::compare(path, few_only);
  hl::golden::write(path, hl::golden::hashAll());
  return 0;
}
