#include "base/error.h"

#include <gtest/gtest.h>

namespace pleinair {
namespace {

Result<int> Half(int number) {
  if (number % 2 != 0) return InputError("numbers.txt:3", "is odd", "give an even number");
  return number / 2;
}

Result<int> Quarter(int number) {
  PLEINAIR_ASSIGN_OR_RETURN(const int half, Half(number));
  PLEINAIR_RETURN_IF_ERROR(Half(half));
  return Half(half);
}

TEST(Error, SaysWhereWhatAndTheWayOutInOneLine) {
  EXPECT_EQ(Half(3).error().Message(), "numbers.txt:3: is odd; give an even number");
  EXPECT_EQ((Error{ErrorKind::kSystem, "", "no display", ""}.Message()), "no display");
}

TEST(Error, PassesThroughTheMacros) {
  EXPECT_EQ(*Quarter(12), 3);
  EXPECT_EQ(Quarter(6).error().what, "is odd");
  EXPECT_EQ(Quarter(7).error().what, "is odd");
}

TEST(Error, KindsTellTheUsersFaultFromTheMachines) {
  EXPECT_EQ(InputError("a", "b").value().kind, ErrorKind::kInput);
  EXPECT_EQ(SystemError("a", "b").value().kind, ErrorKind::kSystem);
}

}  // namespace
}  // namespace pleinair
