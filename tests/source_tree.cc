#include "tests/source_tree.h"

namespace pleinair::tests {

std::filesystem::path SourceTree() { return PLEINAIR_SOURCE_DIR; }

}  // namespace pleinair::tests
