// Flag: says whether something still runs that may end by a return, by an exception, or by being dropped where it
// waits, as a coroutine may.
#pragma once

namespace hl {

/// `set` is true while this lives. One thread.
class Flag {
 public:
  explicit Flag(bool& set) : set_(set) { set_ = true; }
  ~Flag() { set_ = false; }
  Flag(const Flag&) = delete;
  Flag& operator=(const Flag&) = delete;

 private:
  bool& set_;
};

}  // namespace hl
