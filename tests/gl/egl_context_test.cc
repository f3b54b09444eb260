#include "gl/egl_context.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/gl/gl_fixture.h"

namespace pleinair::gl {
namespace {

TEST(EglContext, GivesOpenGl45CoreWithoutADisplay) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const Result<EglContext> context = EglContext::Create();
  ASSERT_TRUE(context.has_value()) << context.error().Message();
  GLint major = 0, minor = 0, profile = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(major * 10 + minor, 45);
  EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
  EXPECT_FALSE(context->info().renderer.empty());
  EXPECT_FALSE(context->info().platform.empty());
}

TEST(EglContextDeathTest, NeedsAddressSpaceAndSaysHowMuch) {
  EXPECT_EXIT(
      {
        rlimit limit{};
        getrlimit(RLIMIT_AS, &limit);
        limit.rlim_cur = rlim_t{800} << 20;
        setrlimit(RLIMIT_AS, &limit);
        const Result<EglContext> context = EglContext::Create();
        std::fputs(context ? "no error" : context.error().what.c_str(), stderr);
        _exit(context ? 0 : 3);
      },
      ::testing::ExitedWithCode(3), "800 MiB of address space, and drawing needs 1024");
}

TEST(EglContext, CollectsTheDriversErrors) {
  Result<EglContext> context = EglContext::Create({.debug = true});
  ASSERT_TRUE(context.has_value()) << context.error().Message();
  EXPECT_TRUE(context->TakeErrors().empty());
  glEnable(GL_TEXTURE_2D_ARRAY);  // Not a capability: GL_INVALID_ENUM.
  EXPECT_EQ(context->TakeErrors().size(), 1U);
  EXPECT_TRUE(context->TakeErrors().empty());
}

TEST(EglContext, SeveralLiveAtOnceAndEndInAnyOrder) {
  Result<EglContext> first = EglContext::Create();
  ASSERT_TRUE(first.has_value());
  {
    const Result<EglContext> second = EglContext::Create();
    ASSERT_TRUE(second.has_value());
  }
  ASSERT_TRUE(first->MakeCurrent().has_value());
  GLint value = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &value);
  EXPECT_GE(value, 4096);
}

TEST(EglContext, MovesToAnotherThread) {
  Result<EglContext> context = EglContext::Create();
  ASSERT_TRUE(context.has_value());
  context->ReleaseCurrent();
  bool current = false;
  std::thread([&] {
    current = context->MakeCurrent().has_value();
    context->ReleaseCurrent();
  }).join();
  EXPECT_TRUE(current);
}

}  // namespace
}  // namespace pleinair::gl
