#include "app/project/questions.h"

namespace pleinair::app {
namespace {

std::string WithoutBlanks(const std::string& text) {
  constexpr const char* kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

}  // namespace

Result<std::string> Questions::Ask(const std::string& question, const std::string& offered,
                                   const Check& check) {
  for (;;) {
    text_ << question;
    if (!offered.empty()) text_ << " [" << offered << "]";
    text_ << ": " << std::flush;
    std::string line;
    if (!std::getline(answers_, line)) {
      text_ << '\n';
      return InputError("", "not every question was answered",
                        "answer them, or give the values as options ('pleinair new --help')");
    }
    std::string answer = WithoutBlanks(line);
    if (answer.empty()) answer = offered;
    if (answer.empty()) continue;
    const Result<void> good = check(answer);
    if (good) return answer;
    text_ << "  " << good.error().Message() << '\n';
  }
}

}  // namespace pleinair::app
