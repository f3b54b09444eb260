#pragma once

// Internal: not installed.

#include <filesystem>

#include "devices/films/libav_pointer.h"

namespace pleinair::devices {

/// Opens a film by libavformat without reading its tracks; null where it cannot. Only this file is
/// read, whatever it refers to: no network, playlist or list of files.
LibavPointer<AVFormatContext> OpenLibavInput(const std::filesystem::path& film);

}  // namespace pleinair::devices
