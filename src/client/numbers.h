// Numbers: a growing list of doubles. Unlike std::vector it grows in place where the memory allows it (realloc), so
// that millions of vertices are neither copied nor touched twice on their way.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

namespace hl::client {

class Numbers {
 public:
  Numbers() = default;
  Numbers(Numbers&& other) noexcept
      : data_(std::move(other.data_)), size_(std::exchange(other.size_, 0)), room_(std::exchange(other.room_, 0)) {}
  Numbers& operator=(Numbers&& other) noexcept {
    data_ = std::move(other.data_);
    size_ = std::exchange(other.size_, 0);
    room_ = std::exchange(other.room_, 0);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const double* data() const { return data_.get(); }
  const double* begin() const { return data_.get(); }
  const double* end() const { return data_.get() + size_; }

  bool hasRoom(std::size_t count) const { return room_ - size_ >= count; }
  /// Throws std::bad_alloc and changes nothing.
  void makeRoom(std::size_t count) {
    if (!hasRoom(count)) grow(size_ + count);
  }
  /// There must be room.
  template <std::size_t Count>
  void appendInRoom(const std::array<double, Count>& numbers) {
    std::copy_n(numbers.data(), Count, data_.get() + size_);
    size_ += Count;
  }
  template <std::size_t Count>
  void append(const std::array<double, Count>& numbers) {
    makeRoom(Count);
    appendInRoom(numbers);
  }
  void append(const Numbers& numbers) {
    makeRoom(numbers.size_);
    std::copy_n(numbers.data_.get(), numbers.size_, data_.get() + size_);
    size_ += numbers.size_;
  }
  /// To at most `size` numbers; the memory stays.
  void shorten(std::size_t size) { size_ = std::min(size_, size); }
  void clear() { size_ = 0; }

 private:
  struct Free {
    void operator()(double* data) const { std::free(data); }
  };
  static constexpr std::size_t kMinRoom = 96;  // 32 vertices: small primitives never grow

  void grow(std::size_t needed) {
    const std::size_t room = std::max({needed, room_ + room_ / 2, kMinRoom});
    auto* data = static_cast<double*>(std::realloc(data_.get(), room * sizeof(double)));
    if (data == nullptr) throw std::bad_alloc();
    static_cast<void>(data_.release());  // realloc has freed or kept it
    data_.reset(data);
    room_ = room;
  }

  std::unique_ptr<double[], Free> data_;
  std::size_t size_ = 0, room_ = 0;
};

}  // namespace hl::client
