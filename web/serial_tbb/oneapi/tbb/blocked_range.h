// In the place of oneTBB's header, for builds without threads: the ranges and algorithms that HL uses, one after the
// other on the calling thread.
#pragma once

#include <cstddef>

namespace oneapi::tbb {

template <typename Value>
class blocked_range {
 public:
  blocked_range(Value begin, Value end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
  Value begin() const { return begin_; }
  Value end() const { return end_; }
  std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
  bool is_divisible() const { return grain_ < size(); }
  Value middle() const { return begin_ + (end_ - begin_) / 2; }
  std::size_t grainsize() const { return grain_; }

 private:
  Value begin_, end_;
  std::size_t grain_;
};

}  // namespace oneapi::tbb
