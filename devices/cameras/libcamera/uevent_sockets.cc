#include "devices/cameras/libcamera/uevent_sockets.h"

#include <linux/filter.h>
#include <linux/netlink.h>
#include <sys/socket.h>

#include <charconv>
#include <filesystem>
#include <string>
#include <system_error>

namespace pleinair::devices {
namespace {

int SocketOption(int socket, int option) {
  int value = -1;
  socklen_t length = sizeof value;
  return getsockopt(socket, SOL_SOCKET, option, &value, &length) == 0 ? value : -1;
}

}  // namespace

std::vector<int> UeventSockets() {
  std::vector<int> sockets;
  std::error_code ended;
  for (std::filesystem::directory_iterator each("/proc/self/fd", ended), end; !ended && each != end;
       each.increment(ended)) {
    const std::string name = each->path().filename().string();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (SocketOption(descriptor, SO_DOMAIN) == AF_NETLINK &&
        SocketOption(descriptor, SO_PROTOCOL) == NETLINK_KOBJECT_UEVENT) {
      sockets.push_back(descriptor);
    }
  }
  return sockets;
}

bool MuteSocket(int socket) {
  sock_filter nothing = BPF_STMT(BPF_RET | BPF_K, 0);
  const sock_fprog program{1, &nothing};
  return setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0;
}

}  // namespace pleinair::devices
