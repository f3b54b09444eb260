#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstring>

#include "devices/cameras/camera_list.h"
#include "tests/vm/camera_helpers.h"

namespace pleinair::vm {

std::string VividNode() {
  static const std::string node = [] {
    for (const devices::CameraDescription& camera : devices::ListCameras(false).cameras) {
      if (camera.driver == "vivid") return camera.node;
    }
    return std::string();
  }();
  return node;
}

void SetByName(const std::string& node, const char* name, int value) {
  const int fd = open(node.substr(5).c_str(), O_RDWR);
  ASSERT_GE(fd, 0);
  v4l2_queryctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  bool found = false;
  while (ioctl(fd, VIDIOC_QUERYCTRL, &query) == 0) {
    if (std::strcmp(reinterpret_cast<const char*>(query.name), name) == 0) {
      v4l2_control control{};
      control.id = query.id;
      control.value = value;
      found = ioctl(fd, VIDIOC_S_CTRL, &control) == 0;
      break;
    }
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  close(fd);
  ASSERT_TRUE(found) << name;
}

}  // namespace pleinair::vm
