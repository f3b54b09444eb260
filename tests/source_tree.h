#pragma once

#include <filesystem>

namespace pleinair::tests {

/// The source tree that the tests were built from. No macro of its path: every file that is
/// compiled with one differs from checkout to checkout, and ccache finds none of them again.
std::filesystem::path SourceTree();

}  // namespace pleinair::tests
