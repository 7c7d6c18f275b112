#include "engine/session/image_codec.h"

#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/base/check.h"
#include "engine/session/cdr.h"

namespace helical {
namespace {

constexpr int kJpegQuality = 90;
constexpr std::uint32_t kLargestSide = 1u << 14;
constexpr std::size_t kMostPixels = 64u << 20;

struct Encoding {
  PixelFormat format;
  const char* name;
  int to_bgr;  ///< OpenCV's conversion; negative: none. Its Bayer names are of the second row's pixels.
};
constexpr std::array kEncodings{
    Encoding{PixelFormat::kMono8, "mono8", cv::COLOR_GRAY2BGR},
    Encoding{PixelFormat::kBgr8, "bgr8", -1},
    Encoding{PixelFormat::kRgb8, "rgb8", cv::COLOR_RGB2BGR},
    Encoding{PixelFormat::kBayerRg8, "bayer_rggb8", cv::COLOR_BayerBG2BGR},
    Encoding{PixelFormat::kBayerGr8, "bayer_grbg8", cv::COLOR_BayerGB2BGR},
    Encoding{PixelFormat::kBayerGb8, "bayer_gbrg8", cv::COLOR_BayerGR2BGR},
    Encoding{PixelFormat::kBayerBg8, "bayer_bggr8", cv::COLOR_BayerRG2BGR},
};

const Encoding& encodingOf(PixelFormat format) {
  for (const Encoding& encoding : kEncodings)
    if (encoding.format == format) return encoding;
  HELICAL_CHECK(false && "a pixel format without a name");
}

cv::Mat toBgr(const std::uint8_t* pixels, int width, int height, std::size_t stride,
              const Encoding& encoding) {
  const int type = bytesPerPixel(encoding.format) == 3 ? CV_8UC3 : CV_8UC1;
  // OpenCV has no matrix of constant pixels; nobody writes to this one.
  const cv::Mat image(height, width, type, const_cast<std::uint8_t*>(pixels), stride);
  if (encoding.to_bgr < 0) return image;
  cv::Mat bgr;
  cv::cvtColor(image, bgr, encoding.to_bgr);
  return bgr;
}

BgrImage copyOf(const cv::Mat& image) {
  const cv::Mat packed = image.isContinuous() ? image : image.clone();
  return {packed.cols, packed.rows, {packed.data, packed.data + packed.total() * packed.elemSize()}};
}

/// Of a JPEG, from its frame header: what it claims is what its decoder would take memory for.
bool hasReasonableSize(std::string_view jpeg) {
  const auto at = [&](std::size_t i) { return static_cast<unsigned>(static_cast<std::uint8_t>(jpeg[i])); };
  if (jpeg.size() < 4 || at(0) != 0xff || at(1) != 0xd8) return false;
  for (std::size_t i = 2; i + 9 <= jpeg.size();) {
    if (at(i) != 0xff) return false;
    const unsigned marker = at(i + 1);
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame) {
      const std::size_t height = at(i + 5) << 8 | at(i + 6), width = at(i + 7) << 8 | at(i + 8);
      return width > 0 && height > 0 && width * height <= kMostPixels;
    }
    i += 2 + (at(i + 2) << 8 | at(i + 3));
  }
  return false;
}

}  // namespace

const char* encodingName(PixelFormat format) {
  return encodingOf(format).name;
}

std::string jpegOf(const RecordedFrame& frame) {
  const auto stride = static_cast<std::size_t>(frame.width * bytesPerPixel(frame.format));
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg",
               toBgr(frame.pixels.data(), frame.width, frame.height, stride, encodingOf(frame.format)), bytes,
               {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return {bytes.begin(), bytes.end()};
}

BgrImage decodeImage(std::string_view payload) {
  CdrReader in(payload);
  in.get<std::int32_t>();
  in.get<std::uint32_t>();
  in.getText();
  const auto height = in.get<std::uint32_t>(), width = in.get<std::uint32_t>();
  const std::string_view name = in.getText();
  in.getBool();
  const auto stride = in.get<std::uint32_t>();
  const std::string_view pixels = in.getBytes();
  for (const Encoding& encoding : kEncodings) {
    if (name != encoding.name) continue;
    if (width == 0 || height == 0 || width > kLargestSide || height > kLargestSide ||
        stride < width * static_cast<std::uint32_t>(bytesPerPixel(encoding.format)) ||
        pixels.size() < std::size_t{stride} * height)
      throw CutShort();
    return copyOf(toBgr(reinterpret_cast<const std::uint8_t*>(pixels.data()), static_cast<int>(width),
                        static_cast<int>(height), stride, encoding));
  }
  throw CutShort();
}

BgrImage decodeCompressedImage(std::string_view payload) {
  CdrReader in(payload);
  in.get<std::int32_t>();
  in.get<std::uint32_t>();
  in.getText();
  in.getText();
  const std::string_view bytes = in.getBytes();
  if (!hasReasonableSize(bytes)) throw CutShort();
  try {
    const cv::Mat image =
        cv::imdecode(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
    if (image.empty()) throw CutShort();
    return copyOf(image);
  } catch (const cv::Exception&) {
    throw CutShort();
  }
}

}  // namespace helical
