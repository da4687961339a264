// ObjectTable: which objects are defined and whom they call, so that a circle is seen before anything is sent. What is
// in them is not kept.
#pragma once

#include <hl/hl_types.h>

#include <map>
#include <set>
#include <vector>

namespace hl::client {

class ObjectTable {
 public:
  /// A number > 0 that was never returned or defined before.
  HLuint generate();
  bool isDefined(HLuint object) const { return calls_.contains(object); }
  /// Defines or redefines `object`, which calls `calls`.
  void define(HLuint object, std::set<HLuint> calls);
  /// Unknown objects are ignored.
  void remove(HLuint object);
  /// Whether `from` is `to` or calls it, directly or not.
  bool reaches(HLuint from, HLuint to) const;
  /// Hands over what has become of removed objects since the last time: those that are still called, by an object or by
  /// the world (`world_calls`), have to be emptied; those that nobody calls any more can be deleted.
  struct Removals {
    std::vector<HLuint> empty, deleted;
  };
  Removals takeRemovals(const std::set<HLuint>& world_calls);

 private:
  std::set<HLuint> calledObjects() const;

  std::map<HLuint, std::set<HLuint>> calls_;  // by defined object
  std::map<HLuint, bool> removed_;            // and not yet deleted; whether it has been emptied
  HLuint highest_ = 0;
};

}  // namespace hl::client
