// Values: a structure as two plain lists, in the order of its fields (base/fields.h). What is written this way comes
// back bit for bit.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/fields.h"
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
  template <int kRows, int kColumns>
  void operator()(const Eigen::Matrix<double, kRows, kColumns>& m) {
    values_.numbers.insert(values_.numbers.end(), m.data(), m.data() + m.size());
  }
  template <typename T>
  requires std::integral<T> || std::is_enum_v<T>
  void operator()(const T& integer) { values_.integers.push_back(static_cast<std::int64_t>(integer)); }

 private:
  Values& values_;
};

/// How lists of values suit a structure.
enum class Fit {
  kFits,
  kOtherForm,   ///< there are more or fewer of them: another version wrote them
  kImpossible,  ///< a number that its field can not hold, or that its enumeration has no name for
};

/// Sets each member that it is shown; one that the lists have no good value for stays as it is.
class ValueReader {
 public:
  explicit ValueReader(const Values& values) : values_(values) {}
  void operator()(double& number) { take(&number, 1); }
  template <int kRows, int kColumns>
  void operator()(Eigen::Matrix<double, kRows, kColumns>& m) {
    take(m.data(), static_cast<std::size_t>(m.size()));
  }
  template <std::integral T>
  void operator()(T& integer) {
    const std::int64_t* const read = next();
    if (read == nullptr) return;
    if (inRange<T>(*read)) {
      integer = static_cast<T>(*read);
    } else {
      possible_ = false;
    }
  }
  template <typename T>
  requires std::is_enum_v<T>
  void operator()(T& named) {
    const std::int64_t* const read = next();
    if (read == nullptr) return;
    if (inRange<std::underlying_type_t<T>>(*read) && isNamed(static_cast<T>(*read))) {
      named = static_cast<T>(*read);
    } else {
      possible_ = false;
    }
  }
  Fit fit() const {
    if (number_ != values_.numbers.size() || integer_ != values_.integers.size()) return Fit::kOtherForm;
    return possible_ ? Fit::kFits : Fit::kImpossible;
  }

 private:
  // 64-bit numbers without a sign go through those with one, and come back.
  template <typename T>
  static bool inRange(std::int64_t read) {
    return static_cast<std::int64_t>(static_cast<T>(read)) == read;
  }
  void take(double* to, std::size_t count) {
    if (number_ + count <= values_.numbers.size())
      std::memcpy(to, values_.numbers.data() + number_, count * sizeof(double));
    number_ += count;
  }
  const std::int64_t* next() {
    const std::size_t at = integer_++;
    return at < values_.integers.size() ? &values_.integers[at] : nullptr;
  }

  const Values& values_;
  std::size_t number_ = 0, integer_ = 0;
  bool possible_ = true;
};

/// All fields of `value`.
template <typename T>
Values valuesOf(T value) {
  Values values;
  ValueWriter writer(values);
  visitFields(value, writer);
  return values;
}

/// Sets `value` from what valuesOf() gave.
template <typename T>
Fit setFrom(const Values& values, T& value) {
  ValueReader reader(values);
  visitFields(value, reader);
  return reader.fit();
}

}  // namespace hl
