#include "app/output/scratch_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

namespace pleinair::app {

namespace fs = std::filesystem;

Result<ScratchFolder> ScratchFolder::Create() {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "pleinair-XXXXXX").string();
  if (error || mkdtemp(name.data()) == nullptr) {
    return SystemError(name, "cannot be made", "set TMPDIR to a folder that can be written");
  }
  return ScratchFolder(name);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace pleinair::app
