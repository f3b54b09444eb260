#include "devices/cameras/aravis/gige_probe.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace pleinair::devices {
namespace {

constexpr std::uint16_t kControlPort = 3956;

bool SaysNobody(int error_number) {
  return error_number == ECONNREFUSED || error_number == EHOSTUNREACH ||
         error_number == ENETUNREACH || error_number == ENETDOWN || error_number == ENODEV;
}

}  // namespace

GigeProbe::GigeProbe(const sockaddr_in& camera)
    : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  sockaddr_in control = camera;
  control.sin_port = htons(kControlPort);
  // Only a connected socket receives the report that a port is closed.
  if (socket_ >= 0 &&
      connect(socket_, reinterpret_cast<const sockaddr*>(&control), sizeof control) != 0) {
    close(socket_);
    socket_ = -1;
  }
}

GigeProbe::~GigeProbe() {
  if (socket_ >= 0) close(socket_);
}

bool GigeProbe::IsRefused() {
  if (socket_ < 0) return false;
  std::array<std::uint8_t, 64> answer{};
  while (true) {
    const ssize_t got = recv(socket_, answer.data(), answer.size(), 0);
    if (got >= 0) continue;
    if (errno == EINTR) continue;
    if (SaysNobody(errno)) return true;
    break;
  }
  if (++number_ == 0) number_ = 1;  // Zero is not a valid request number.
  // Key, acknowledge flag, READREG, length, request number; the register's address.
  const std::array<std::uint8_t, 12> question{0x42,
                                              0x01,
                                              0x00,
                                              0x80,
                                              0x00,
                                              0x04,
                                              static_cast<std::uint8_t>(number_ >> 8),
                                              static_cast<std::uint8_t>(number_ & 0xff),
                                              0x00,
                                              0x00,
                                              0x0a,
                                              0x00};
  return send(socket_, question.data(), question.size(), MSG_NOSIGNAL) < 0 && SaysNobody(errno);
}

}  // namespace pleinair::devices
