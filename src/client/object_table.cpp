#include "client/object_table.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "client/fault.h"

namespace hl::client {

HLuint ObjectTable::generate() {
  if (highest_ == std::numeric_limits<HLuint>::max())
    throw Fault(HL_OUT_OF_MEMORY, "all numbers of objects are in use");
  return ++highest_;
}

void ObjectTable::define(HLuint object, std::set<HLuint> calls) {
  calls_[object] = std::move(calls);
  removed_.erase(object);
  highest_ = std::max(highest_, object);
}

bool ObjectTable::reaches(HLuint from, HLuint to) const {
  std::set<HLuint> seen{from};
  std::vector<HLuint> open{from};
  while (!open.empty()) {
    const HLuint object = open.back();
    open.pop_back();
    if (object == to) return true;
    const auto found = calls_.find(object);
    if (found == calls_.end()) continue;
    for (const HLuint called : found->second)
      if (seen.insert(called).second) open.push_back(called);
  }
  return false;
}

void ObjectTable::remove(HLuint object) {
  if (calls_.erase(object) != 0) removed_[object] = false;
}

std::set<HLuint> ObjectTable::calledObjects() const {
  std::set<HLuint> called;
  for (const auto& [object, calls] : calls_) called.insert(calls.begin(), calls.end());
  return called;
}

ObjectTable::Removals ObjectTable::takeRemovals(const std::set<HLuint>& world_calls) {
  Removals removals;
  if (removed_.empty()) return removals;
  const std::set<HLuint> called = calledObjects();
  for (auto entry = removed_.begin(); entry != removed_.end();) {
    auto& [object, emptied] = *entry;
    if (called.contains(object) || world_calls.contains(object)) {
      if (!emptied) removals.empty.push_back(object);
      emptied = true;
      ++entry;
    } else {
      removals.deleted.push_back(object);
      entry = removed_.erase(entry);
    }
  }
  return removals;
}

}  // namespace hl::client
