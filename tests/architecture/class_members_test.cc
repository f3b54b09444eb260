#include "tests/architecture/class_members.h"
#include "tests/architecture/include_rules.h"
#include "tests/source_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fstream>

namespace pleinair::architecture {
namespace {

using ::testing::IsEmpty;

/// A class with more data members has more than one responsibility (CONTRIBUTING.md).
constexpr std::size_t kMaxMembers = 12;

std::size_t MembersOf(std::string_view text) {
  const auto classes = ParseClasses(text);
  return classes.empty() ? 99 : classes.back().members;
}

TEST(ClassMembers, AreAtMostTwelveInTheWholeSourceTree) {
  std::size_t classes = 0;
  for (const auto& file : FindSources(tests::SourceTree())) {
    if (file.extension() != ".h" && file.extension() != ".cc") continue;
    std::ifstream in(tests::SourceTree() / file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    if (IsSimdCode(text)) continue;
    for (const ClassMembers& found : ParseClasses(text)) {
      ++classes;
      EXPECT_LE(found.members, kMaxMembers) << file.generic_string() << ":" << found.line << ": "
                                            << found.name << " has too many data members";
    }
  }
  EXPECT_GT(classes, 300U);
}

TEST(ParseClasses, CountsEachDeclarator) {
  EXPECT_EQ(MembersOf("struct A { int a; };"), 1U);
  EXPECT_EQ(MembersOf("struct A { double a, b = 2.0; };"), 2U);
  EXPECT_EQ(MembersOf("struct A { double a{1}, b[2] = {1, 2}, c{}; };"), 3U);
  EXPECT_EQ(MembersOf("struct A { Box box{1, 2}; int x = F(1, 2), y; };"), 3U);
  EXPECT_EQ(MembersOf("struct A { std::map<int, int> m; std::array<Vec<int, 2>, 3> a, b; };"), 3U);
  EXPECT_EQ(MembersOf("struct A { int shifted = 1 << 2; bool less = 1 < 2; };"), 2U);
  EXPECT_EQ(MembersOf("struct A { alignas(64) float a[4]{}; decltype(x) b{1}; int c; };"), 3U);
}

TEST(ParseClasses, CountsMembersThatHoldFunctions) {
  EXPECT_EQ(MembersOf("struct A { std::function<void(int, int)> f, g; };"), 2U);
  EXPECT_EQ(MembersOf("struct A { void (*f)(int, int) = nullptr; int b; };"), 2U);
  EXPECT_EQ(MembersOf("struct A { void (*f)(int){nullptr}; int b; };"), 2U);
  EXPECT_EQ(MembersOf("struct A { std::function<int()> f = [] { int a; return a; }; };"), 1U);
}

TEST(ParseClasses, CountsNeitherStaticsNorFunctionsNorTypes) {
  EXPECT_EQ(MembersOf("struct A { static constexpr int a = 1; inline static int b; };"), 0U);
  EXPECT_EQ(MembersOf("class A { public: A() : a_{1}, b_(2) { int c; } private: int a_, b_; };"),
            2U);
  EXPECT_EQ(MembersOf("struct A { [[nodiscard]] int F(int a, int b) const; A(A&&) = default; };"),
            0U);
  EXPECT_EQ(MembersOf("struct A { bool operator==(const A&) const = default; explicit operator "
                      "bool() const { return a; } int a; };"),
            1U);
  EXPECT_EQ(MembersOf("struct A { std::vector<int> F() const { return {1, 2}; } };"), 0U);
  EXPECT_EQ(MembersOf("struct A { using B = int; enum C { kD, kE }; struct F; friend class G; };"),
            0U);
  EXPECT_EQ(MembersOf("struct A { template <typename T> void F(T t); };"), 0U);
}

TEST(ParseClasses, ReadsNoCommentsStringsOrDirectives) {
  EXPECT_EQ(MembersOf("struct A { // int b;\n /* int c; */ int a = '}'; };"), 1U);
  EXPECT_EQ(MembersOf("struct A { std::string a = \"};\\\"};\"; int b = 1'000; };"), 2U);
  EXPECT_EQ(MembersOf("struct A {\n#define B {\n std::string a = R\"(};)\"; };"), 1U);
}

TEST(ParseClasses, FindsNestedAndLocalClassesByName) {
  const auto classes = ParseClasses(
      "class A::B final : public C<int, 2>, D {\n struct E { int a; } e_, f_;\n"
      " void G() { struct H { int a, b, c; }; }\n struct stat status_{};\n};\n"
      "enum class I { kJ };\ntemplate <class T>\nstruct K<T> {};");
  ASSERT_EQ(classes.size(), 4U);
  EXPECT_EQ(classes[0].name, "A::B::E");
  EXPECT_EQ(classes[0].line, 2);
  EXPECT_EQ(classes[0].members, 1U);
  EXPECT_EQ(classes[1].name, "A::B::H");
  EXPECT_EQ(classes[1].members, 3U);
  EXPECT_EQ(classes[2].name, "A::B");
  EXPECT_EQ(classes[2].line, 1);
  EXPECT_EQ(classes[2].members, 3U);
  EXPECT_EQ(classes[3].name, "K");
}

TEST(ParseClasses, FindsNoneInForwardDeclarationsAndTemplateParameters) {
  EXPECT_THAT(ParseClasses("class A; struct B* b; template <class T, class U> void F() {}"),
              IsEmpty());
}

TEST(IsSimdCode, IsWhatIncludesHighway) {
  EXPECT_TRUE(IsSimdCode("#include \"hwy/highway.h\"\n"));
  EXPECT_FALSE(IsSimdCode("#include <vector>\n"));
}

}  // namespace
}  // namespace pleinair::architecture
