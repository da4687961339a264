// What binds the calls of hl.h: a call that makes an error raises it, on the thread that made it.
#pragma once

#include <hl/hl.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <type_traits>

/// Throws the error that a call has just made on this thread.
void throwFailure();
/// Throws when the thread has no current context, as the calls would do nothing.
void requireContext();

/// `call` between the two: what is true or false becomes a bool.
template <typename Result, typename... Arguments>
auto checked(Result (*call)(Arguments...)) {
  return [call](Arguments... arguments) {
    requireContext();
    if constexpr (std::is_void_v<Result>) {
      call(arguments...);
      throwFailure();
    } else {
      const Result result = call(arguments...);
      throwFailure();
      if constexpr (std::is_same_v<Result, HLboolean>)
        return result != HL_FALSE;
      else
        return result;
    }
  };
}

/// Of a call that takes `Size` numbers: any sequence of that length.
template <std::size_t Size, typename Number>
auto checkedVector(void (*call)(const Number*)) {
  return [call](const std::array<Number, Size>& numbers) {
    requireContext();
    call(numbers.data());
    throwFailure();
  };
}

/// Made by generate_calls.py: the calls that take and return numbers only, the constants, and how many values a query
/// writes.
void bindPlainCalls(pybind11::module_& module);
void bindConstants(pybind11::module_& module);
std::size_t valuesOf(HLenum query);

/// Contexts and events.
void bindContext(pybind11::module_& module);
/// The calls that wait for the server: other Python threads run meanwhile.
void bindWaitingCalls(pybind11::module_& module);
/// The calls with arrays.
void bindArrayCalls(pybind11::module_& module);
