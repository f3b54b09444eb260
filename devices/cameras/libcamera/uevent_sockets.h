#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

namespace pleinair::devices {

/// This process's sockets on which the kernel or udev announces added and removed devices. Empty
/// without /proc.
std::vector<int> UeventSockets();

/// Blocks further messages to a socket; those received before remain readable.
bool MuteSocket(int socket);

}  // namespace pleinair::devices
