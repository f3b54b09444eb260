#pragma once

#include <filesystem>

namespace pleinair::exports {

/// The sound of a film that is copied, packet by packet, without decoding.
struct CopiedSound {
  std::filesystem::path film;
  double start_s = 0.0;  ///< The container's time that becomes zero in the output.
};

}  // namespace pleinair::exports
