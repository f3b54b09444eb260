// uvc-sim: a USB Video Class camera made of software. It speaks USB/IP to the vhci-hcd kernel
// module through a socket pair, so the kernel's real uvcvideo driver binds to it: real /dev/video*,
// real UVC controls, real unplug. For use inside the test VM (modules vhci-hcd and uvcvideo).
// Built by tests/vm/CMakeLists.txt.
//
// Usage: uvc-sim [--iso] [--fps N] [--mjpeg-only] [--err-every N] [--short-every N] [--drop-every
// N]
//                [--unplug-after N] [--replug-ms MS] [--stall-after N] [--seconds S] [--port P]
//                [--grey FILE W H]
// Commands on standard input, one a line: unplug, plug, stall, run, err (next frame), short (next
// frame), quit
// --grey plays a file of 8-bit grey frames of W x H (looped; other sizes get the ramp), so a
// rendered or recorded sequence with known poses can be sent through the whole capture path. It
// prints 'ready' once attached, 'stream W H FORMAT' at each start, 'ctrl UNIT CS VALUE' at each
// control write. Luma of each frame: a moving ramp scaled by exposure*gain; the first 8 rows hold
// the 32-bit frame counter (8 pixels a bit, 255 for 1, lowest bit first), so a reader can check
// order and loss against what was sent (not with --grey).
#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <vector>
#if __has_include(<jpeglib.h>)
#include <jpeglib.h>
#define HAVE_JPEG 1
#endif
using Bytes = std::vector<uint8_t>;
static bool g_iso = false, g_mjpegOnly = false;
static std::vector<uint8_t> g_grey;
static int g_greyW = 0, g_greyH = 0;
static int g_fps = 30;
static int64_t nowUs() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}
static void le16(Bytes& b, unsigned v) {
  b.push_back(v & 255);
  b.push_back(v >> 8 & 255);
}
static void le32(Bytes& b, uint32_t v) {
  le16(b, v & 0xffff);
  le16(b, v >> 16);
}
static void put(Bytes& b, std::initializer_list<int> l) {
  for (int v : l) b.push_back(uint8_t(v));
}
static void add(Bytes& b, const Bytes& o) { b.insert(b.end(), o.begin(), o.end()); }

struct Size {
  int w, h;
};
static const Size kSizes[] = {{640, 480}, {320, 240}, {1280, 720}};
static const int kIntervals[] = {333333, 666666, 166666};  // 100 ns units: 30, 15, 60 fps
static const unsigned kPayload = 16384, kIsoPacket = 3 * 1024;

static Bytes deviceDescriptor() {
  return {18, 1, 0x00, 0x02, 0xEF, 2, 1, 64, 0x6b, 0x1d, 0x05, 0x01, 0x00, 0x01, 1, 2, 3, 1};
}

static Bytes frames(int subtype, int bytesPerPixel) {
  Bytes b;
  int idx = 1;
  for (const Size& s : kSizes) {
    put(b, {26 + 4 * 3, 0x24, subtype, idx++, 0});
    le16(b, s.w);
    le16(b, s.h);
    uint32_t bits = uint32_t(s.w) * s.h * bytesPerPixel * 8;
    le32(b, bits * 15);
    le32(b, bits * 60);
    le32(b, uint32_t(s.w) * s.h * bytesPerPixel);
    le32(b, kIntervals[0]);
    put(b, {3});
    le32(b, kIntervals[2]);
    le32(b, kIntervals[0]);
    le32(b, kIntervals[1]);
  }
  put(b, {6, 0x24, 0x0d, 1, 1, 4});
  return b;
}

static Bytes configDescriptor() {
  Bytes units;  // camera terminal 1 -> processing unit 2 -> USB streaming terminal 3
  put(units, {18, 0x24, 0x02, 1, 0x01, 0x02, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0x0A | 0x20, 0x00,
              0x02});  // AE mode, exposure, focus, auto focus
  put(units, {12, 0x24, 0x05, 2, 1, 0, 0, 2, 0x41, 0x16, 0,
              0});  // brightness, WB temperature, gain, power line, auto WB
  put(units, {9, 0x24, 0x03, 3, 0x01, 0x01, 0, 2, 0});
  Bytes vc;
  put(vc, {13, 0x24, 0x01, 0x10, 0x01});
  le16(vc, 13 + units.size());
  le32(vc, 1000000);
  put(vc, {1, 1});
  add(vc, units);

  Bytes fmt;
  int n = 0;
  if (!g_mjpegOnly) {
    put(fmt, {27, 0x24, 0x04, ++n, 3,    'Y',  'U',  'Y', '2', 0, 0, 0x10, 0, 0x80,
              0,  0,    0xaa, 0,   0x38, 0x9b, 0x71, 16,  1,   0, 0, 0,    0});
    add(fmt, frames(0x05, 2));
  }
#ifdef HAVE_JPEG
  put(fmt, {11, 0x24, 0x06, ++n, 3, 1, 1, 0, 0, 0, 0});
  add(fmt, frames(0x07, 2));
#endif
  Bytes vs;
  put(vs, {13 + n, 0x24, 0x01, n});
  le16(vs, 13 + n + fmt.size());
  put(vs, {0x81, 0, 3, 0, 0, 0, 1});
  for (int i = 0; i < n; ++i) put(vs, {0});
  add(vs, fmt);

  Bytes body;
  put(body, {8, 11, 0, 2, 0x0e, 3, 0, 2});
  put(body, {9, 4, 0, 0, 0, 0x0e, 1, 0, 2});
  add(body, vc);
  put(body, {9, 4, 1, 0, g_iso ? 0 : 1, 0x0e, 2, 0, 0});
  add(body, vs);
  if (g_iso) {
    put(body, {9, 4, 1, 1, 1, 0x0e, 2, 0, 0});
    put(body, {7, 5, 0x81, 0x05});
    le16(body, 0x1400);
    put(body, {1});
  } else {
    put(body, {7, 5, 0x81, 0x02});
    le16(body, 512);
    put(body, {0});
  }
  Bytes b;
  put(b, {9, 2});
  le16(b, 9 + body.size());
  put(b, {2, 1, 0, 0x80, 250});
  add(b, body);
  return b;
}

struct Control {
  int len;
  uint32_t min, max, res, def, cur;
};
struct Urb {
  uint32_t seq, len;
  Bytes iso;
  uint32_t packets;
};

class Camera {
 public:
  std::map<int, Control> controls = {  // key: unit << 8 | selector
      {0x102,
       {1, 1, 8, 9, 8, 8}},  // AE mode: 1 manual, 8 aperture priority (RES is the bitmap of modes)
      {0x104, {4, 3, 2047, 1, 250, 250}},
      {0x106, {2, 0, 250, 5, 0, 0}},
      {0x108, {1, 0, 1, 1, 1, 1}},
      {0x202, {2, 0, 255, 1, 128, 128}},
      {0x204, {2, 0, 255, 1, 64, 64}},
      {0x205, {1, 0, 2, 1, 2, 2}},
      {0x20a, {2, 2800, 6500, 10, 4600, 4600}},
      {0x20b, {1, 0, 1, 1, 1, 1}}};
  int errEvery = 0, shortEvery = 0, dropEvery = 0, unplugAfter = 0, stallAfter = 0, replugMs = -1,
      port = 0;
  bool stalled = false, errNext = false, shortNext = false;
  int64_t replugAt = 0;
  int fd = -1;
  uint32_t frame = 0, sent = 0, dropped = 0;

  bool attach() {
    int sv[2];
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, sv)) {
      perror("socketpair");
      return false;
    }
    int big = 4 << 20;
    setsockopt(sv[0], SOL_SOCKET, SO_SNDBUF, &big, sizeof big);
    setsockopt(sv[1], SOL_SOCKET, SO_SNDBUF, &big, sizeof big);
    FILE* f = fopen("/sys/devices/platform/vhci_hcd.0/attach", "w");
    if (!f) {
      perror("vhci_hcd attach (is the module loaded?)");
      return false;
    }
    fprintf(f, "%d %d %d %d", port, sv[1], 0x10002, 3);
    int rc = fclose(f);
    close(sv[1]);
    if (rc) {
      perror("attach");
      close(sv[0]);
      return false;
    }
    fd = sv[0];
    pending.clear();
    streaming = false;
    offset = 0;
    active = false;
    probe = {};
    probeInit();
    return true;
  }
  void unplug() {
    if (fd < 0) return;
    close(fd);
    fd = -1;
    pending.clear();
    streaming = false;
    printf("unplugged after %u frames sent\n", sent);
    fflush(stdout);
    if (replugMs >= 0) replugAt = nowUs() + replugMs * 1000LL;
  }
  void probeInit() {
    probe.assign(34, 0);
    probe[0] = 1;
    probe[2] = 1;
    probe[3] = 1;
    set32(4, kIntervals[0]);
    fix();
  }
  bool onReadable() {
    uint8_t h[48];
    if (!readAll(h, 48)) {
      unplug();
      return false;
    }
    auto be = [&](int o) {
      uint32_t v;
      memcpy(&v, h + o, 4);
      return ntohl(v);
    };
    uint32_t cmd = be(0), seq = be(4), dir = be(12), ep = be(16);
    if (cmd == 2) {  // unlink
      uint32_t victim = be(20);
      bool found = false;
      for (auto it = pending.begin(); it != pending.end(); ++it)
        if (it->seq == victim) {
          pending.erase(it);
          found = true;
          break;
        }
      uint8_t r[48] = {};
      put32(r, 4);
      put32(r + 4, seq);
      put32(r + 20, found ? uint32_t(-104) : 0);
      writeAll(r, 48);
      return true;
    }
    if (cmd != 1) {
      fprintf(stderr, "uvc-sim: unknown command %u\n", cmd);
      unplug();
      return false;
    }
    uint32_t len = be(24), packets = be(32);
    if (packets == 0xffffffffu) packets = 0;
    Bytes out;
    if (dir == 0 && len) {
      out.resize(len);
      if (!readAll(out.data(), len)) {
        unplug();
        return false;
      }
    }
    Bytes iso(packets * 16);
    if (packets && !readAll(iso.data(), iso.size())) {
      unplug();
      return false;
    }
    if (ep == 0) {
      control(seq, h + 40, out);
      return true;
    }
    pending.push_back({seq, len, iso, packets});
    return true;
  }
  // Send what is due; returns microseconds until the next thing to do.
  int64_t pump() {
    int64_t now = nowUs();
    if (fd < 0) {
      if (replugAt && now >= replugAt) {
        replugAt = 0;
        if (attach()) {
          puts("replugged");
          fflush(stdout);
        }
      }
      return 20000;
    }
    if (!streaming) return 50000;
    if (stalled) {
      if (!active) return 20000;
    }
    if (!active && now >= due) {
      due += interval / 10;
      if (now > due + interval / 2) {
        due = now + interval / 10;
      }
      ++frame;
      if (dropEvery && frame % dropEvery == 0) {
        ++dropped;
        return 0;
      }
      makeFrame();
      active = true;
      offset = 0;
      fid ^= 1;
      pts = uint32_t(now);
      bad = errNext || (errEvery && frame % errEvery == 0);
      errNext = false;
      if (shortNext || (shortEvery && frame % shortEvery == 0)) data.resize(data.size() / 2);
      shortNext = false;
    }
    while (!pending.empty() && (active || g_iso)) {
      Urb u = pending.front();
      if (g_iso) {
        if (now < isoDue) break;
        isoDue = std::max(isoDue + 1000 * int64_t(u.packets) / 8, now);
        sendIso(u);
      } else
        sendBulk(u);
      pending.pop_front();
      if (!active) {
        if (unplugAfter && sent >= uint32_t(unplugAfter)) {
          unplugAfter = 0;
          unplug();
          return 20000;
        }
        if (stallAfter && sent >= uint32_t(stallAfter)) {
          stallAfter = 0;
          stalled = true;
          puts("stalled");
          fflush(stdout);
        }
        if (fd < 0) return 20000;
        if (!g_iso) break;
      }
    }
    if (g_iso && !pending.empty()) return std::max<int64_t>(0, isoDue - nowUs());
    return active ? 5000 : std::max<int64_t>(0, due - nowUs());
  }

 private:
  std::deque<Urb> pending;
  Bytes probe, commit, data;
  bool streaming = false, active = false, bad = false;
  size_t offset = 0;
  int fid = 0;
  uint32_t pts = 0;
  int64_t due = 0, isoDue = 0;
  int interval = 333333;

  static void put32(uint8_t* p, uint32_t v) {
    v = htonl(v);
    memcpy(p, &v, 4);
  }
  void set32(int o, uint32_t v) {
    for (int i = 0; i < 4; ++i) probe[o + i] = v >> (8 * i);
  }
  uint32_t get32(const Bytes& b, int o) {
    return b[o] | b[o + 1] << 8 | b[o + 2] << 16 | uint32_t(b[o + 3]) << 24;
  }
  void fix() {  // make a legal answer of whatever the host asked for
    int nf = 1;
#ifdef HAVE_JPEG
    nf = g_mjpegOnly ? 1 : 2;
#endif
    probe[2] = std::clamp<int>(probe[2], 1, nf);
    probe[3] = std::clamp<int>(probe[3], 1, 3);
    uint32_t want = get32(probe, 4), best = kIntervals[0];
    for (int i : kIntervals)
      if (std::abs(int64_t(i) - want) < std::abs(int64_t(best) - want)) best = i;
    set32(4, best);
    const Size& s = kSizes[probe[3] - 1];
    set32(18, s.w * s.h * 2);
    set32(22, g_iso ? kIsoPacket : kPayload);
    set32(26, 1000000);
    probe[30] = 3;
    probe[31] = 1;
    probe[32] = 1;
    probe[33] = 1;
  }
  bool mjpeg() const { return g_mjpegOnly || commit[2] == 2; }
  bool readAll(void* p, size_t n) {
    auto* c = static_cast<uint8_t*>(p);
    while (n) {
      ssize_t k = read(fd, c, n);
      if (k <= 0) return false;
      c += k;
      n -= k;
    }
    return true;
  }
  bool writeAll(const void* p, size_t n) {
    auto* c = static_cast<const uint8_t*>(p);
    while (n) {
      ssize_t k = send(fd, c, n, MSG_NOSIGNAL);
      if (k <= 0) return false;
      c += k;
      n -= k;
    }
    return true;
  }
  void reply(uint32_t seq, int status, const Bytes& in, uint32_t actual, const Bytes& iso = {},
             uint32_t packets = 0) {
    Bytes m(48, 0);
    put32(&m[0], 3);
    put32(&m[4], seq);
    put32(&m[20], uint32_t(status));
    put32(&m[24], actual);
    put32(&m[32], packets ? packets : 0);
    add(m, in);
    add(m, iso);
    writeAll(m.data(), m.size());
  }
  void control(uint32_t seq, const uint8_t* s, const Bytes& out) {
    int type = s[0], req = s[1], val = s[2] | s[3] << 8, idx = s[4] | s[5] << 8,
        len = s[6] | s[7] << 8;
    Bytes in;
    bool ok = true;
    if (type == 0x80 && req == 6) {
      switch (val >> 8) {
        case 1:
          in = deviceDescriptor();
          break;
        case 2:
          in = configDescriptor();
          break;
        case 3:
          in = str(val & 255);
          break;
        case 6:
          in = {10, 6, 0, 2, 0xEF, 2, 1, 64, 1, 0};
          break;
        default:
          ok = false;
      }
    } else if (type == 0x80 && req == 8)
      in = {1};
    else if ((type & 0x9f) == 0x80 || (type & 0x9f) == 0x81 || (type & 0x9f) == 0x82) {
      if ((type & 0x60) == 0) in = {0, 0};
    }
    if ((type & 0x60) == 0) {
      if (type == 0x01 && req == 11) {
        if (idx == 1) {
          if (val == 1)
            start();
          else
            stop();
        }
      } else if (type == 0x02 && req == 1)
        stop();  // clear halt on the bulk endpoint ends a stream
    } else if ((type & 0x7f) == 0x21)
      ok = classRequest(req, val >> 8, idx & 255, idx >> 8, out, in);
    if (int(in.size()) > len) in.resize(len);
    if (!ok) {
      reply(seq, -32, {}, 0);
      return;
    }
    reply(seq, 0, in, (type & 0x80) ? uint32_t(in.size()) : uint32_t(len));
  }
  Bytes str(int i) {
    if (i == 0) return {4, 3, 9, 4};
    const char* t = i == 1 ? "Software" : i == 2 ? "UVC test camera" : "0001";
    Bytes b = {uint8_t(2 + 2 * strlen(t)), 3};
    for (; *t; ++t) {
      b.push_back(*t);
      b.push_back(0);
    }
    return b;
  }
  bool classRequest(int req, int cs, int iface, int unit, const Bytes& out, Bytes& in) {
    if (iface == 1) {  // streaming: 1 probe, 2 commit
      if (cs != 1 && cs != 2) return false;
      if (req == 0x01) {
        std::copy_n(out.begin(), std::min(out.size(), probe.size()), probe.begin());
        fix();
        if (cs == 2) {
          commit = probe;
          if (!g_iso) start();
        }
        return true;
      }
      if (req == 0x85) {
        le16(in, 34);
        return true;
      }
      if (req == 0x86) {
        in = {3};
        return true;
      }
      in = probe;
      return true;
    }
    if (unit == 0) {
      if (req == 0x86)
        in = {1};
      else
        in = {0};
      return cs == 2;
    }
    auto it = controls.find(unit << 8 | cs);
    if (it == controls.end()) return false;
    Control& c = it->second;
    uint32_t v = 0;
    switch (req) {
      case 0x01:
        for (int i = 0; i < c.len && i < int(out.size()); ++i) v |= uint32_t(out[i]) << (8 * i);
        c.cur = v;
        printf("ctrl %d 0x%02x %u\n", unit, cs, v);
        fflush(stdout);
        return true;
      case 0x81:
        v = c.cur;
        break;
      case 0x82:
        v = c.min;
        break;
      case 0x83:
        v = c.max;
        break;
      case 0x84:
        v = c.res;
        break;
      case 0x87:
        v = c.def;
        break;
      case 0x85:
        le16(in, c.len);
        return true;
      case 0x86:
        in = {3};
        return true;
      default:
        return false;
    }
    for (int i = 0; i < c.len; ++i) in.push_back(v >> (8 * i));
    return true;
  }
  void start() {
    if (commit.empty()) commit = probe;
    const Size& s = kSizes[commit[3] - 1];
    interval = get32(commit, 4);
    if (g_fps != 30) interval = 10000000 / g_fps;
    streaming = true;
    active = false;
    due = nowUs() + interval / 10;
    isoDue = nowUs();
    printf("stream %d %d %s\n", s.w, s.h, mjpeg() ? "MJPG" : "YUYV");
    fflush(stdout);
  }
  void stop() {
    if (streaming) {
      printf("stop frames=%u sent=%u dropped=%u\n", frame, sent, dropped);
      fflush(stdout);
    }
    streaming = false;
    active = false;
  }
  uint8_t luma(int x, int y) {
    double scale = controls[0x104].cur / 250.0 * controls[0x204].cur / 64.0;
    int v = int(((x + y + frame * 4) & 127) * scale) + int(controls[0x202].cur) - 64;
    return uint8_t(std::clamp(v, 0, 255));
  }
  void makeFrame() {
    const Size& s = kSizes[commit[3] - 1];
    Bytes y(s.w * s.h);
    for (int r = 0; r < s.h; ++r)
      for (int x = 0; x < s.w; ++x)
        y[r * s.w + x] = (r < 8 && x < 256) ? ((frame >> (x / 8)) & 1 ? 255 : 0) : 0;
    static thread_local std::vector<uint8_t> ramp;
    ramp.resize(s.w + s.h);
    for (int i = 0; i < s.w + s.h; ++i) ramp[i] = luma(i, 0);
    for (int r = 8; r < s.h; ++r) memcpy(&y[r * s.w], &ramp[r], s.w);
    if (s.w == g_greyW && s.h == g_greyH) {
      size_t n = y.size();
      memcpy(y.data(), &g_grey[(frame - 1) % (g_grey.size() / n) * n], n);
    }
    if (!mjpeg()) {
      data.resize(y.size() * 2);
      for (size_t i = 0; i < y.size(); ++i) {
        data[2 * i] = y[i];
        data[2 * i + 1] = 128;
      }
      return;
    }
#ifdef HAVE_JPEG
    jpeg_compress_struct c{};
    jpeg_error_mgr e;
    c.err = jpeg_std_error(&e);
    jpeg_create_compress(&c);
    unsigned char* mem = nullptr;
    unsigned long n = 0;
    jpeg_mem_dest(&c, &mem, &n);
    c.image_width = s.w;
    c.image_height = s.h;
    c.input_components = 1;
    c.in_color_space = JCS_GRAYSCALE;
    jpeg_set_defaults(&c);
    jpeg_set_quality(&c, 80, TRUE);
    jpeg_start_compress(&c, TRUE);
    while (int(c.next_scanline) < s.h) {
      JSAMPROW row = &y[c.next_scanline * s.w];
      jpeg_write_scanlines(&c, &row, 1);
    }
    jpeg_finish_compress(&c);
    data.assign(mem, mem + n);
    free(mem);
    jpeg_destroy_compress(&c);
#endif
  }
  Bytes header(bool last) {
    Bytes h = {12, uint8_t(0x80 | 0x04 | 0x08 | (fid & 1) | (last ? 2 : 0) | (bad ? 0x40 : 0))};
    le32(h, pts);
    le32(h, uint32_t(nowUs()));
    le16(h, (nowUs() / 1000) & 0x7ff);
    return h;
  }
  size_t chunk(Bytes& to, size_t room) {  // append one payload of at most room bytes
    size_t n = std::min(room - 12, data.size() - offset);
    bool last = offset + n >= data.size();
    add(to, header(last));
    to.insert(to.end(), data.begin() + offset, data.begin() + offset + n);
    offset += n;
    if (last) {
      active = false;
      ++sent;
    }
    return n + 12;
  }
  void sendBulk(const Urb& u) {
    Bytes p;
    p.reserve(u.len);
    chunk(p, std::min<size_t>(u.len, kPayload));
    reply(u.seq, 0, p, p.size());
  }
  void sendIso(const Urb& u) {
    Bytes p, d;
    uint32_t total = 0;
    for (uint32_t i = 0; i < u.packets; ++i) {
      uint32_t off, len;
      memcpy(&off, &u.iso[i * 16], 4);
      memcpy(&len, &u.iso[i * 16 + 4], 4);
      len = ntohl(len);
      size_t n = active ? chunk(p, len) : 0;
      total += n;
      uint8_t q[16];
      memcpy(q, &off, 4);
      put32(q + 4, len);
      put32(q + 8, n);
      put32(q + 12, 0);
      d.insert(d.end(), q, q + 16);
    }
    reply(u.seq, 0, p, total, d, u.packets);
  }
};

int main(int argc, char** argv) {
  Camera cam;
  int seconds = 600;
  setvbuf(stdout, nullptr, _IOLBF, 0);
  auto num = [&](int& i) { return i + 1 < argc ? atoi(argv[++i]) : 0; };
  for (int i = 1; i < argc; ++i) {
    std::string a = argv[i];
    if (a == "--iso")
      g_iso = true;
    else if (a == "--mjpeg-only")
      g_mjpegOnly = true;
    else if (a == "--fps")
      g_fps = std::max(1, num(i));
    else if (a == "--err-every")
      cam.errEvery = num(i);
    else if (a == "--short-every")
      cam.shortEvery = num(i);
    else if (a == "--drop-every")
      cam.dropEvery = num(i);
    else if (a == "--unplug-after")
      cam.unplugAfter = num(i);
    else if (a == "--replug-ms")
      cam.replugMs = num(i);
    else if (a == "--stall-after")
      cam.stallAfter = num(i);
    else if (a == "--seconds")
      seconds = num(i);
    else if (a == "--port")
      cam.port = num(i);
    else if (a == "--grey" && i + 3 < argc) {
      FILE* f = fopen(argv[++i], "rb");
      if (!f) {
        perror(argv[i]);
        return 2;
      }
      fseek(f, 0, SEEK_END);
      g_grey.resize(size_t(ftell(f)));
      rewind(f);
      if (fread(g_grey.data(), 1, g_grey.size(), f) != g_grey.size()) return 2;
      fclose(f);
      g_greyW = num(i);
      g_greyH = num(i);
      if (g_grey.size() < size_t(g_greyW) * g_greyH || g_greyW < 1) {
        fputs("--grey: file too small\n", stderr);
        return 2;
      }
    } else {
      fprintf(stderr, "unknown option %s\n", a.c_str());
      return 2;
    }
  }
  if (!cam.attach()) return 1;
  puts("ready");
  int64_t end = nowUs() + seconds * 1000000LL;
  bool in = true;
  std::string line;
  while (nowUs() < end) {
    int64_t wait = cam.pump();
    pollfd p[2] = {{cam.fd, POLLIN, 0}, {in ? 0 : -1, POLLIN, 0}};
    poll(p, 2, int(std::min<int64_t>((wait + 999) / 1000, 100)));
    if (cam.fd >= 0 && (p[0].revents & (POLLIN | POLLHUP))) cam.onReadable();
    if (p[1].revents & (POLLIN | POLLHUP)) {
      char b[256];
      ssize_t n = read(0, b, sizeof b);
      if (n <= 0) {
        in = false;
        continue;
      }
      line.append(b, n);
      size_t e;
      while ((e = line.find('\n')) != std::string::npos) {
        std::string c = line.substr(0, e);
        line.erase(0, e + 1);
        if (c == "unplug")
          cam.unplug();
        else if (c == "plug") {
          if (cam.fd < 0 && cam.attach()) puts("plugged");
        } else if (c == "stall")
          cam.stalled = true;
        else if (c == "run")
          cam.stalled = false;
        else if (c == "err")
          cam.errNext = true;
        else if (c == "short")
          cam.shortNext = true;
        else if (c == "quit")
          return 0;
      }
    }
  }
  return 0;
}
