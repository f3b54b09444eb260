#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "gl/egl_context.h"

namespace pleinair::gl {

/// Gives each test a current debug context and fails it on any driver message.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Result<EglContext> context = EglContext::Create({.debug = true});
    ASSERT_TRUE(context.has_value()) << context.error().Message();
    context_.emplace(std::move(*context));
  }
  void TearDown() override {
    if (!context_) return;
    for (const std::string& error : context_->TakeErrors()) ADD_FAILURE() << "GL: " << error;
  }

  std::optional<EglContext> context_;
};

}  // namespace pleinair::gl
