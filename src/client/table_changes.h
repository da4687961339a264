// TableChanges: the entries of a table by number as they were before a frame changed them, so that the changes can be
// undone, also when later frames have changed some of them again.
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
  /// Both become one: these, and then `later`.
  void merge(TableChanges&& later) { before_.merge(later.before_); }
  /// The `earlier` ones are to be undone, and these stay: of the entries that both have changed it is left to these to
  /// go back to what was before both.
  void inheritFrom(TableChanges& earlier) {
    for (auto& [number, entry] : before_) {
      auto inherited = earlier.before_.extract(number);
      if (!inherited.empty()) entry = std::move(inherited.mapped());
    }
  }
  void undo(Table& table) {
    for (auto& [number, entry] : before_) {
      if (entry)
        table[number] = std::move(*entry);
      else
        table.erase(number);
    }
    before_.clear();
  }

 private:
  std::map<HLuint, std::optional<Entry>> before_;  // none: there was none
};

}  // namespace hl::client
