// SampleList: what the device did between two states, until the application takes it.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

#include <cstddef>
#include <deque>

namespace hl::client {

class SampleList {
 public:
  /// From now on the newest `most`.
  void keep(std::size_t most);
  void add(const proto::ClientState& state);
  /// The oldest, at most `most`; they are forgotten.
  std::size_t take(std::size_t most, HLsample* samples);

 private:
  void dropOldest();

  std::size_t most_ = 0;
  std::deque<HLsample> samples_;
};

}  // namespace hl::client
