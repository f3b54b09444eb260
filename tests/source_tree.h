#pragma once

#include <filesystem>

namespace pleinair::tests {

/// The source tree of the tests. The path is not a macro: a file compiled with such a macro differs
/// between checkouts, so ccache would never find it.
std::filesystem::path SourceTree();

}  // namespace pleinair::tests
