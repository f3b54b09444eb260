#pragma once

#include <functional>
#include <istream>
#include <ostream>
#include <string>

#include "base/error.h"

namespace pleinair::app {

/// Asks a person on a terminal.
class Questions {
 public:
  /// Both must outlive this object.
  Questions(std::istream& answers, std::ostream& text) : answers_(answers), text_(text) {}

  /// Checks an answer; its error is shown, and the question is asked again.
  using Check = std::function<Result<void>(const std::string&)>;

  /// Returns the answer without blanks around it. An empty answer is `offered`, where that is not
  /// empty. Error (input): the answers ended.
  Result<std::string> Ask(const std::string& question, const std::string& offered,
                          const Check& check);

 private:
  std::istream& answers_;
  std::ostream& text_;
};

}  // namespace pleinair::app
