// TableChanges: the entries of a table by number as they were before they were changed, so that the changes can be
// undone.
#pragma once

#include <hl/hl_types.h>

#include <map>
#include <optional>
#include <utility>

namespace hl::client {

template <typename Entry>
class TableChanges {
 public:
  using Table = std::map<HLuint, Entry>;

  /// Before the entry is made, changed or removed; what was remembered first stays.
  void remember(const Table& table, HLuint number) {
    if (before_.contains(number)) return;
    const auto found = table.find(number);
    before_[number] = found == table.end() ? std::nullopt : std::optional(found->second);
  }
  /// The changes stay.
  void forget() { before_.clear(); }
  void undo(Table& table) {
    for (auto& [number, entry] : before_) {
      if (entry)
        table[number] = std::move(*entry);
      else
        table.erase(number);
    }
    forget();
  }

 private:
  std::map<HLuint, std::optional<Entry>> before_;  // none: there was none
};

}  // namespace hl::client
