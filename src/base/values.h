// Values: a structure as two plain lists, in the order in which its visitFields() shows its members. What is written
// this way comes back bit for bit.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "base/vec.h"

namespace hl {

struct Values {
  std::vector<double> numbers;
  std::vector<std::int64_t> integers;

  /// Bit for bit: 0 is not -0, and a NaN is itself.
  bool operator==(const Values& other) const {
    return integers == other.integers && numbers.size() == other.numbers.size() &&
           (numbers.empty() || std::memcmp(numbers.data(), other.numbers.data(), numbers.size() * sizeof(double)) == 0);
  }
};

/// Appends each member that it is shown.
class ValueWriter {
 public:
  explicit ValueWriter(Values& values) : values_(values) {}
  void operator()(const double& number) { values_.numbers.push_back(number); }
  void operator()(const Vec3& v) { values_.numbers.insert(values_.numbers.end(), v.data(), v.data() + 3); }
  template <typename T>
  requires std::integral<T> || std::is_enum_v<T>
  void operator()(const T& integer) { values_.integers.push_back(static_cast<std::int64_t>(integer)); }

 private:
  Values& values_;
};

/// Sets each member that it is shown; what the lists do not have is left as it is, and complete() is false.
class ValueReader {
 public:
  explicit ValueReader(const Values& values) : values_(values) {}
  void operator()(double& number) {
    if (has(values_.numbers, number_, 1)) number = values_.numbers[number_];
    number_ += 1;
  }
  void operator()(Vec3& v) {
    if (has(values_.numbers, number_, 3)) std::memcpy(v.data(), &values_.numbers[number_], 3 * sizeof(double));
    number_ += 3;
  }
  template <typename T>
  requires std::integral<T> || std::is_enum_v<T>
  void operator()(T& integer) {
    if (has(values_.integers, integer_, 1)) integer = static_cast<T>(values_.integers[integer_]);
    integer_ += 1;
  }
  /// Exactly all has been read.
  bool complete() const { return number_ == values_.numbers.size() && integer_ == values_.integers.size(); }

 private:
  template <typename List>
  static bool has(const List& list, std::size_t at, std::size_t count) {
    return at + count <= list.size();
  }

  const Values& values_;
  std::size_t number_ = 0, integer_ = 0;
};

/// Everything that visitFields(value, visit) shows.
template <typename T>
Values valuesOf(T value) {
  Values values;
  ValueWriter writer(values);
  visitFields(value, writer);
  return values;
}

/// Sets `value` from what valuesOf() gave; false when it does not fit, as one of another version.
template <typename T>
bool setFrom(const Values& values, T& value) {
  ValueReader reader(values);
  visitFields(value, reader);
  return reader.complete();
}

}  // namespace hl
