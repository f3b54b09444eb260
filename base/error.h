#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <tl/expected.hpp>

namespace pleinair {

/// Kind of failure; decides the exit code of the command.
enum class ErrorKind {
  kInput,   ///< The user's file, device or command line is wrong or incomplete: exit code 2.
  kSystem,  ///< The machine could not do it (disk full, no EGL): exit code 1.
};

/// A failure, reported to the user: what is wrong, where (file, line, device), and what to do next.
struct Error {
  ErrorKind kind = ErrorKind::kInput;
  std::string where;   ///< File or device, with line or byte where known; may be empty.
  std::string what;    ///< What is wrong, without a final full stop.
  std::string remedy;  ///< What the user can do; may be empty.

  /// One line: "where: what; remedy".
  std::string Message() const {
    std::string message = where.empty() ? what : where + ": " + what;
    if (!remedy.empty()) message += "; " + remedy;
    return message;
  }
};

template <typename T>
using Result = tl::expected<T, Error>;

/// Shorthands for returning an error from a function that returns a Result.
inline tl::unexpected<Error> InputError(std::string where, std::string what,
                                        std::string remedy = {}) {
  return tl::make_unexpected(
      Error{ErrorKind::kInput, std::move(where), std::move(what), std::move(remedy)});
}

inline tl::unexpected<Error> SystemError(std::string where, std::string what,
                                         std::string remedy = {}) {
  return tl::make_unexpected(
      Error{ErrorKind::kSystem, std::move(where), std::move(what), std::move(remedy)});
}

}  // namespace pleinair

#define PLEINAIR_CONCAT_INNER(a, b) a##b
#define PLEINAIR_CONCAT(a, b) PLEINAIR_CONCAT_INNER(a, b)

// NOLINTBEGIN(bugprone-macro-parentheses): `lhs` may be a declaration.
/// Declares `lhs` from the value of a Result, or returns its error from the enclosing function.
#define PLEINAIR_ASSIGN_OR_RETURN(lhs, expression) \
  PLEINAIR_ASSIGN_OR_RETURN_IMPL(PLEINAIR_CONCAT(result_, __LINE__), lhs, expression)
#define PLEINAIR_ASSIGN_OR_RETURN_IMPL(result, lhs, expression)         \
  auto result = (expression);                                           \
  if (!result) return ::tl::make_unexpected(std::move(result).error()); \
  lhs = *std::move(result)
// NOLINTEND(bugprone-macro-parentheses)

/// Returns the error of a Result<void> from the enclosing function.
#define PLEINAIR_RETURN_IF_ERROR(expression)                              \
  do {                                                                    \
    auto status = (expression);                                           \
    if (!status) return ::tl::make_unexpected(std::move(status).error()); \
  } while (false)
