#pragma once

#include <linux/videodev2.h>
#include <poll.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "devices/cameras/v4l2/v4l2_io.h"

namespace pleinair::devices {

/// A simulated driver: nodes, the formats and controls of one camera, and buffers that a test
/// fills. Not thread-safe.
class FakeV4l2 : public V4l2Io {
 public:
  struct FakeNode {
    std::string serial, bus = "usb-1";
    __u32 caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    int open_error = 0;
  };
  std::map<std::string, FakeNode> nodes{{"/dev/video0", {"0001"}}};
  std::vector<__u32> formats{V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_MJPEG};
  v4l2_pix_format pixels{};
  std::map<__u32, int> controls;         ///< Value by id; other controls do not exist.
  std::vector<std::string> calls;        ///< Control writes in order: "id=value".
  std::map<unsigned long, int> failing;  ///< Error number by request.
  int poll_events = POLLIN;
  v4l2_buffer next{};  ///< Result of VIDIOC_DQBUF.
  std::string memory = std::string(4096, 'x');
  std::set<int> open_fds;
  int maps = 0;
  bool streaming = false;
  int queued = 0;

  FakeV4l2() {
    next.bytesused = 8 * 4 * 2;
    next.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
    next.timestamp = {12, 345678};
  }

  int Open(const std::string& node) override {
    const auto found = nodes.find(node);
    if (found == nodes.end()) return -ENOENT;
    if (found->second.open_error != 0) return -found->second.open_error;
    opened_ = node;
    return *open_fds.insert(100 + next_fd_++).first;
  }
  void Close(int fd) override { open_fds.erase(fd); }
  void* Map(int, std::size_t, std::size_t) override {
    ++maps;
    return memory.data();
  }
  void Unmap(void*, std::size_t) override { --maps; }
  int Poll(int, int, int) override { return poll_events; }
  std::vector<Node> Nodes() override {
    std::vector<Node> list;
    for (const auto& [path, node] : nodes) list.push_back({path, node.serial});
    return list;
  }

  int Ioctl(int, unsigned long request, void* argument) override {
    if (const auto fails = failing.find(request); fails != failing.end()) return -fails->second;
    switch (request) {
      case VIDIOC_QUERYCAP: {
        auto* capability = static_cast<v4l2_capability*>(argument);
        capability->capabilities = V4L2_CAP_DEVICE_CAPS;
        capability->device_caps = nodes[opened_].caps;
        std::strcpy(reinterpret_cast<char*>(capability->card), "Fake");
        std::strcpy(reinterpret_cast<char*>(capability->bus_info), nodes[opened_].bus.c_str());
        return 0;
      }
      case VIDIOC_ENUM_FMT: {
        auto* entry = static_cast<v4l2_fmtdesc*>(argument);
        if (entry->index >= formats.size()) return -EINVAL;
        entry->pixelformat = formats[entry->index];
        return 0;
      }
      case VIDIOC_ENUM_FRAMESIZES: {
        auto* entry = static_cast<v4l2_frmsizeenum*>(argument);
        if (entry->index > 0) return -EINVAL;
        entry->type = V4L2_FRMSIZE_TYPE_DISCRETE;
        entry->discrete = {8, 4};
        return 0;
      }
      case VIDIOC_ENUM_FRAMEINTERVALS: {
        auto* entry = static_cast<v4l2_frmivalenum*>(argument);
        if (entry->index > 0) return -EINVAL;
        entry->type = V4L2_FRMIVAL_TYPE_DISCRETE;
        entry->discrete = {1, 30};
        return 0;
      }
      case VIDIOC_G_FMT:
        static_cast<v4l2_format*>(argument)->fmt.pix = pixels;
        return 0;
      case VIDIOC_S_FMT: {
        v4l2_pix_format& requested = static_cast<v4l2_format*>(argument)->fmt.pix;
        requested.width = 8;  // The only supported size.
        requested.height = 4;
        requested.bytesperline = 16;
        requested.field = V4L2_FIELD_NONE;
        requested.colorspace = pixels.colorspace;
        requested.quantization = pixels.quantization;
        requested.ycbcr_enc = pixels.ycbcr_enc;
        return 0;
      }
      case VIDIOC_S_PARM:
        return 0;
      case VIDIOC_G_PARM:
        static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe = {1, 30};
        return 0;
      case VIDIOC_REQBUFS:
        return 0;
      case VIDIOC_QUERYBUF:
        static_cast<v4l2_buffer*>(argument)->length = static_cast<__u32>(memory.size());
        return 0;
      case VIDIOC_QBUF:
        ++queued;
        return 0;
      case VIDIOC_DQBUF:
        *static_cast<v4l2_buffer*>(argument) = next;
        --queued;
        return 0;
      case VIDIOC_STREAMON:
        streaming = true;
        return 0;
      case VIDIOC_STREAMOFF:
        streaming = false;
        return 0;
      case VIDIOC_QUERYCTRL: {
        auto* query = static_cast<v4l2_queryctrl*>(argument);
        if (!controls.contains(query->id)) return -EINVAL;
        query->minimum = 1;
        query->maximum = 5000;
        return 0;
      }
      case VIDIOC_G_CTRL: {
        auto* control = static_cast<v4l2_control*>(argument);
        if (!controls.contains(control->id)) return -EINVAL;
        control->value = controls[control->id];
        return 0;
      }
      case VIDIOC_S_CTRL: {
        const auto* control = static_cast<v4l2_control*>(argument);
        calls.push_back(std::to_string(control->id) + "=" + std::to_string(control->value));
        // As uvcvideo: the value is rejected while automatic control is on.
        if (control->id == V4L2_CID_EXPOSURE_ABSOLUTE &&
            controls[V4L2_CID_EXPOSURE_AUTO] == V4L2_EXPOSURE_APERTURE_PRIORITY) {
          return -EACCES;
        }
        controls[control->id] = control->value;
        return 0;
      }
      default:
        return -ENOTTY;
    }
  }

 private:
  std::string opened_;
  int next_fd_ = 0;
};

}  // namespace pleinair::devices
