#pragma once

// Internal: between the .cc files of this module; not installed.

#include <vector>

namespace pleinair::devices {

/// This process's descriptors through which the kernel or udev tells of devices that come and go.
/// Empty where /proc is not there.
std::vector<int> UeventSockets();

/// Lets nothing through to a socket from now on; what it received before stays.
bool MuteSocket(int socket);

}  // namespace pleinair::devices
