// Remembered: the results of a pure function that takes long, for what it was last asked.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <mutex>
#include <optional>
#include <utility>

namespace hl {

/// Forgets what was asked for longest ago. `Key` has ==; finding takes a time as long as there are entries. By any
/// thread.
template <typename Key, typename Value>
class Remembered {
 public:
  explicit Remembered(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  std::optional<Value> find(const Key& key) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) { return one.key == key; });
    if (found == entries_.end()) return std::nullopt;
    entries_.splice(entries_.begin(), entries_, found);
    return found->value;
  }
  /// `bytes`: of the key and the value, about. What alone is larger than all that may be kept is not.
  void keep(Key key, Value value, std::size_t bytes) {
    if (bytes > most_bytes_) return;
    const std::lock_guard lock(mutex_);
    entries_.push_front({std::move(key), std::move(value), bytes});
    bytes_ += bytes;
    while (bytes_ > most_bytes_) {
      bytes_ -= entries_.back().bytes;
      entries_.pop_back();
    }
  }

 private:
  struct Entry {
    Key key;
    Value value;
    std::size_t bytes = 0;
  };
  const std::size_t most_bytes_;
  std::mutex mutex_;
  std::list<Entry> entries_;  // the last asked for first
  std::size_t bytes_ = 0;
};

}  // namespace hl
