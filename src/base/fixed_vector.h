// FixedVector: a vector with room for N elements inside itself; it never allocates, and an empty one costs nothing.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace hl {

/// RT-safe. push() returns false, and stores nothing, when full.
template <typename T, std::size_t N>
class FixedVector {
  static_assert(std::is_trivially_destructible_v<T>, "elements are dropped without a destructor");

 public:
  // The room is left uninitialised: for hundreds of elements, clearing it would cost more than a tick's work.
  FixedVector() {}  // NOLINT: = default would be deleted by the union
  FixedVector(const FixedVector& other) { *this = other; }
  FixedVector& operator=(const FixedVector& other) {
    if (this != &other) std::uninitialized_copy(other.begin(), other.end(), items_);
    size_ = other.size_;
    return *this;
  }

  bool push(const T& value) {
    if (size_ == N) return false;
    std::construct_at(items_ + size_, value);
    ++size_;
    return true;
  }
  void clear() { size_ = 0; }
  void resize(std::size_t size) {
    assert(size <= size_);
    size_ = size;
  }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  static constexpr std::size_t capacity() { return N; }
  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  T* begin() { return items_; }
  T* end() { return items_ + size_; }
  const T* begin() const { return items_; }
  const T* end() const { return items_ + size_; }

 private:
  union {
    T items_[N];  // NOLINT(readability-identifier-naming): private, though tidy takes a union's members for public
  };
  std::size_t size_ = 0;
};

}  // namespace hl
