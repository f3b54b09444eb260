#include "app/project/questions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace pleinair::app {
namespace {

using ::testing::HasSubstr;

Result<void> OnlyBlue(const std::string& answer) {
  if (answer == "blue") return {};
  return InputError("", "\"" + answer + "\" is not blue", "answer blue");
}

TEST(Questions, AreRepeatedUntilTheAnswerIsGood) {
  std::istringstream answers("\nred\n  blue \r\ngreen\n");
  std::ostringstream text;
  Questions questions(answers, text);
  const auto answer = questions.Ask("Which color", "", OnlyBlue);
  ASSERT_TRUE(answer) << answer.error().Message();
  EXPECT_EQ(*answer, "blue");
  EXPECT_EQ(text.str(),
            "Which color: Which color:   \"red\" is not blue; answer blue\nWhich color: ");
}

TEST(Questions, AnEmptyAnswerTakesWhatIsOffered) {
  std::istringstream answers("\n");
  std::ostringstream text;
  Questions questions(answers, text);
  EXPECT_EQ(questions.Ask("Which color", "blue", OnlyBlue), "blue");
  EXPECT_THAT(text.str(), HasSubstr("[blue]"));
}

TEST(Questions, EndOfInputIsAnError) {
  std::istringstream answers;
  std::ostringstream text;
  Questions questions(answers, text);
  const auto answer = questions.Ask("Which color", "blue", OnlyBlue);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace pleinair::app
