// SampleRoom: the memory of a grid's samples while they come in, in pieces, from a file or a connection.
#pragma once

#include <cstddef>
#include <memory>

namespace hl {

class SampleRoom {
 public:
  /// Throws bad_alloc. Memory is taken as it is filled.
  explicit SampleRoom(std::size_t bytes);
  /// The next samples. Throws hl::Error if there are too many.
  void add(const void* samples, std::size_t bytes);
  bool whole() const { return filled_ == bytes_; }
  /// When it is whole, once; else throws hl::Error. Nothing is copied.
  std::shared_ptr<const void> take();

 private:
  std::size_t bytes_;
  std::shared_ptr<std::byte> memory_;
  std::size_t filled_ = 0;
};

}  // namespace hl
