// Expected failures are values. An Error says where it happened, why, and what the person can do; a Result holds
// either a value or an Error. Programmers' errors are PARSEL_ASSERT, on in every build that runs tests.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>

namespace parsel {

struct Error {
  std::string stage;  ///< folder and step that refused: "shape/gltf_import"
  std::string place;  ///< where in the input: "accessor 3", "line 2, column 7"; empty for the whole of it
  std::string cause;  ///< what is wrong, a clause without a full stop
  std::string fix;    ///< what to do about it, a clause without a full stop

  /// One line for people: "shape/gltf_import: accessor 3: cause; fix."
  std::string message() const;
};

namespace detail {
[[noreturn]] inline void assertion_failed(const char* condition, const char* why, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: %s does not hold: %s\n", file, line, condition, why);
  std::abort();
}
}  // namespace detail

/// A condition that only a mistake in our own code can break. Never for input.
#define PARSEL_ASSERT(condition, why) \
  ((condition) ? (void)0 : ::parsel::detail::assertion_failed(#condition, why, __FILE__, __LINE__))

/// Either a T or the Error that says why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& value() const& {
    PARSEL_ASSERT(ok(), std::get<1>(state_).message().c_str());
    return std::get<0>(state_);
  }
  T& value() & {
    PARSEL_ASSERT(ok(), std::get<1>(state_).message().c_str());
    return std::get<0>(state_);
  }
  T&& value() && {
    PARSEL_ASSERT(ok(), std::get<1>(state_).message().c_str());
    return std::get<0>(std::move(state_));
  }
  const Error& error() const {
    PARSEL_ASSERT(!ok(), "a Result with a value has no error");
    return std::get<1>(state_);
  }

  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

 private:
  std::variant<T, Error> state_;
};

/// A Result without a value: success, or the Error.
using Status = Result<std::monostate>;
inline Status success() {
  return std::monostate{};
}

}  // namespace parsel
