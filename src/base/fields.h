// Fields: shows a visitor every number in a structure, in the order of its declaration, by Boost.PFR. So no list of
// fields is kept by hand, and a field that is added is seen everywhere at once.
#pragma once

#include <array>
#include <boost/pfr/core.hpp>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/vec.h"

namespace hl {

template <typename T>
inline constexpr bool kIsMatrix = false;
template <int kRows, int kColumns>
inline constexpr bool kIsMatrix<Eigen::Matrix<double, kRows, kColumns>> = true;
template <typename T>
inline constexpr bool kIsQuaternion = false;
template <>
inline constexpr bool kIsQuaternion<Eigen::Quaterniond> = true;
template <typename T>
inline constexpr bool kIsArray = false;
template <typename T, std::size_t kSize>
inline constexpr bool kIsArray<std::array<T, kSize>> = true;
template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

template <typename T, typename Visit>
void visitField(T& field, Visit& visit);

/// Calls `visit` with every arithmetic, enumeration and matrix member of a structure and of those in it. An optional is
/// a bool and a value, a quaternion its four numbers. A structure with a base needs an overload of its own: see
/// visitBases().
template <typename T, typename Visit>
void visitFields(T& value, Visit& visit) {
  boost::pfr::for_each_field(value, [&](auto& field) { visitField(field, visit); });
}

/// Stands for a value of any type, where nothing is ever computed.
struct AnyValue {
  template <typename T>
  operator T() const;  // NOLINT: converts by design
};

/// For a structure that has members in its bases only: the compiler refuses one with a member beside them.
template <typename... Bases, typename T, typename Visit>
void visitBases(T& value, Visit& visit) {
  static_assert(
      !requires {
        T{Bases{}..., AnyValue{}};
      },
      "a member of its own would not be seen");
  (visitFields(static_cast<Bases&>(value), visit), ...);
}

template <typename T, typename Visit>
void visitOptional(std::optional<T>& optional, Visit& visit) {
  bool there = optional.has_value();
  T value = optional.value_or(T{});
  visit(there);
  visitField(value, visit);
  optional = there ? std::optional<T>(value) : std::nullopt;
}

template <typename T, typename Visit>
void visitField(T& field, Visit& visit) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || kIsMatrix<T>) {
    visit(field);
  } else if constexpr (kIsQuaternion<T>) {
    visit(field.coeffs());
  } else if constexpr (kIsArray<T>) {
    for (auto& each : field) visitField(each, visit);
  } else if constexpr (kIsOptional<T>) {
    visitOptional(field, visit);
  } else {
    visitFields(field, visit);
  }
}

/// Whether an enumeration has a name for the number `value`; for those that count from 0 without a gap, to 32 at most.
template <typename Enum>
bool isNamed(Enum value) {
  constexpr std::size_t kMax = 32;
  // For a number without a name both compilers print "= (Type)7" here.
  const auto named = []<Enum kValue>() {
    return std::string_view(__PRETTY_FUNCTION__).find("= (") == std::string_view::npos;
  };
  return [&]<std::size_t... kNumbers>(std::index_sequence<kNumbers...>) {
    return ((value == static_cast<Enum>(kNumbers) && named.template operator()<static_cast<Enum>(kNumbers)>()) || ...);
  }
  (std::make_index_sequence<kMax>());
}

}  // namespace hl
