#pragma once

#include <graze/graze.h>

#include <Eigen/Core>
#include <exception>
#include <graze/error.hpp>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

// Every function of the C interface is made of these, so no exception leaves it, and null does no harm.

namespace graze::c {

/// Keeps the sentence that graze_last_error() of this thread returns.
void set_last_error(std::string_view message) noexcept;

/// Is thrown for what the C++ interface cannot be asked: null, or a struct of an impossible size.
class BadArgument : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Runs a function of the C interface, and says how it ended.
template <typename Call>
graze_status guarded(const Call& call) noexcept {
  try {
    call();
    return GRAZE_OK;
  } catch (const BadArgument& bad) {
    set_last_error(bad.what());
    return GRAZE_BAD_ARGUMENT;
  } catch (const Error& error) {
    set_last_error(error.what());
    return GRAZE_REFUSED;
  } catch (const std::bad_alloc&) {
    set_last_error("out of memory");
    return GRAZE_OUT_OF_MEMORY;
  } catch (const std::exception& error) {
    set_last_error(error.what());
    return GRAZE_FAILED;
  } catch (...) {
    set_last_error("an exception that is no std::exception");
    return GRAZE_FAILED;
  }
}

/// Returns what a pointer points at. `name` is that of the parameter.
template <typename Type>
[[nodiscard]] Type& given(Type* pointer, const char* name) {
  if (pointer == nullptr) throw BadArgument(std::string(name) + " is null");
  return *pointer;
}

/// Returns a caller's array. It may be null if it is empty.
template <typename Type>
[[nodiscard]] std::span<Type> array(Type* first, std::size_t count, const char* name) {
  if (first == nullptr && count != 0) throw BadArgument(std::string(name) + " is null");
  return {first, count};
}

/// Returns the numbers of a caller's point, matrix or direction.
template <std::size_t count>
[[nodiscard]] std::span<const double, count> numbers(const double* first, const char* name) {
  return std::span<const double, count>(&given(first, name), count);
}

[[nodiscard]] inline Eigen::Vector3d point_of(const double* first, const char* name) {
  const auto xyz = numbers<3>(first, name);
  return {xyz[0], xyz[1], xyz[2]};
}

}  // namespace graze::c
