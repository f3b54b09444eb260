#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "content/flow/files/flow_file.h"
#include "tests/temporary_folder.h"

namespace pleinair::content {

/// Writes files of velocities and reads them.
class FlowFiles : public ::testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& bytes) {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file.string();
  }

  FlowFile Read(const std::string& file, const FlowFileOptions& options = {}) {
    auto flow = ReadFlowFile(file, options);
    EXPECT_TRUE(flow) << flow.error().Message();
    return flow ? *flow : FlowFile{};
  }

  std::string ErrorOf(const std::string& file, const FlowFileOptions& options = {}) {
    const auto flow = ReadFlowFile(file, options);
    EXPECT_FALSE(flow);
    return flow ? "" : flow.error().Message();
  }

  tests::TemporaryFolder folder_;
};

}  // namespace pleinair::content
