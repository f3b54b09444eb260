#include "devices/cameras/v4l2/v4l2_negotiation.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cmath>

#include "devices/cameras/format_choice.h"
#include "devices/cameras/v4l2/v4l2_status.h"

namespace pleinair::devices {
namespace {

std::optional<double> SetRate(const V4l2Node& node, std::optional<double> rate_hz) {
  constexpr double kThousandths = 1000.0;
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_fract& interval = parameters.parm.capture.timeperframe;
  if (rate_hz) {
    interval.numerator = static_cast<__u32>(kThousandths);
    interval.denominator = static_cast<__u32>(std::lround(*rate_hz * kThousandths));
    // The answer of a driver without rates does not matter: the rate is read back next.
    node.Control(VIDIOC_S_PARM, &parameters);
  }
  parameters = {};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (node.Control(VIDIOC_G_PARM, &parameters) < 0) return std::nullopt;
  if (interval.numerator == 0 || interval.denominator == 0) return std::nullopt;
  return static_cast<double>(interval.denominator) / interval.numerator;
}

// linux/videodev2.h, V4L2_MAP_YCBCR_ENC_DEFAULT and V4L2_MAP_QUANTIZATION_DEFAULT, in one place.
void ReadColorEncoding(const v4l2_pix_format& format, RawImage* layout) {
  __u32 encoding = format.ycbcr_enc;
  if (encoding == V4L2_YCBCR_ENC_DEFAULT) {
    encoding = V4L2_MAP_YCBCR_ENC_DEFAULT(format.colorspace);
  }
  const bool is_709 = encoding == V4L2_YCBCR_ENC_709 || encoding == V4L2_YCBCR_ENC_XV709;
  layout->matrix = is_709 ? YuvMatrix::kBt709 : YuvMatrix::kBt601;
  __u32 range = format.quantization;
  if (range == V4L2_QUANTIZATION_DEFAULT) {
    // Deviation for grey: sensors without color use all 256 values unless they report otherwise.
    range = V4L2_MAP_QUANTIZATION_DEFAULT(false, format.colorspace, encoding);
    if (layout->format == PixelFormat::kGrey8) range = V4L2_QUANTIZATION_FULL_RANGE;
  }
  layout->full_range = range == V4L2_QUANTIZATION_FULL_RANGE;
}

}  // namespace

Result<V4l2NegotiatedFormat> AgreeOnPictures(const V4l2Node& node, const FormatRequest& requested) {
  const std::vector<FormatDescription> formats = node.Formats();
  PLEINAIR_ASSIGN_OR_RETURN(const FormatChoice choice,
                            ChooseFormat(formats, requested, node.path()));
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  int result = node.Control(VIDIOC_G_FMT, &format);
  if (result < 0)
    return tl::make_unexpected(V4l2Error(node.path(), "cannot query its format", -result));
  v4l2_pix_format& pixels = format.fmt.pix;
  if (choice.size) {
    pixels.width = static_cast<__u32>(choice.size->width);
    pixels.height = static_cast<__u32>(choice.size->height);
  }
  // We treat JPEG and MJPG as one format, the driver does not.
  const auto named = [&](std::uint32_t four_cc) {
    return std::any_of(formats.begin(), formats.end(), [&](const FormatDescription& each) {
      return each.name == FourCcName(four_cc);
    });
  };
  const bool plain_jpeg = choice.format == PixelFormat::kMjpeg && !named(V4L2_PIX_FMT_MJPEG);
  pixels.pixelformat = plain_jpeg ? V4L2_PIX_FMT_JPEG : FourCcOf(choice.format);
  pixels.field = V4L2_FIELD_NONE;
  pixels.bytesperline = 0;
  pixels.sizeimage = 0;
  // Let the driver choose the color space; otherwise the previous setting would be written back.
  pixels.colorspace = V4L2_COLORSPACE_DEFAULT;
  pixels.priv = 0;
  result = node.Control(VIDIOC_S_FMT, &format);
  if (result < 0)
    return tl::make_unexpected(V4l2Error(node.path(), "cannot set the image format", -result));
  const std::optional<PixelFormat> got = PixelFormatOf(pixels.pixelformat);
  if (!got) {
    return InputError(node.path(),
                      "requested " + std::string(NameOf(choice.format)) + ", got " +
                          FourCcName(pixels.pixelformat) + ", which is not supported",
                      "request another format");
  }
  if (pixels.field != V4L2_FIELD_NONE && pixels.field != V4L2_FIELD_ANY) {
    return InputError(node.path(), "sends interlaced images, which are not supported",
                      "choose another input or size of the camera");
  }
  V4l2NegotiatedFormat negotiated;
  negotiated.layout.format = *got;
  negotiated.layout.width = static_cast<int>(pixels.width);
  negotiated.layout.height = static_cast<int>(pixels.height);
  negotiated.layout.stride =
      std::max<std::size_t>(pixels.bytesperline, TightStride(*got, negotiated.layout.width));
  ReadColorEncoding(pixels, &negotiated.layout);
  negotiated.reported.format = *got;
  negotiated.reported.size = {negotiated.layout.width, negotiated.layout.height};
  negotiated.reported.rate_hz = SetRate(node, choice.rate_hz);
  negotiated.reported.details = Differences(requested, negotiated.reported);
  return negotiated;
}

}  // namespace pleinair::devices
