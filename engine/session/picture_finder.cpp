#include "engine/session/picture_finder.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/session/image_codec.h"
#include "engine/session/session_writer.h"

namespace helical {
namespace {

constexpr std::array<std::uint8_t, 3> kPaper{38, 33, 30};  // blue, green, red
constexpr std::array<std::uint8_t, 3> kDisc{90, 200, 110};
constexpr double kSmallestDisc = 2.0;  // px

void fillDisc(CameraPicture& picture, const Eigen::Vector2d& centre, double radius) {
  const auto clamped = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size - 1)));
  };
  for (int y = clamped(centre.y() - radius, picture.height);
       y <= clamped(centre.y() + radius, picture.height); ++y) {
    const double half = std::sqrt(std::max(0.0, radius * radius - (y - centre.y()) * (y - centre.y())));
    for (int x = clamped(std::ceil(centre.x() - half), picture.width);
         x <= clamped(centre.x() + half, picture.width); ++x)
      std::copy(kDisc.begin(), kDisc.end(),
                &picture.bgr[3 * static_cast<std::size_t>(y * picture.width + x)]);
  }
}

}  // namespace

PictureFinder::PictureFinder(McapReader& session, const RigConfig& rig) : session_(session) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const std::string topic = cameraTopic(rig, i);
    Images& images = images_[i];
    for (const auto& [id, channel] : session.channels()) {
      const bool compressed = channel.topic == topic + kJpegTopic;
      if (!compressed && channel.topic != topic + kImageTopic) continue;
      images.channel = id;
      images.compressed = compressed;
      for (std::size_t chunk = 0; chunk < session.chunkCount(); ++chunk)
        if (session.mayHold(chunk, {{id}})) images.chunks.push_back(chunk);
      std::stable_sort(images.chunks.begin(), images.chunks.end(), [&](std::size_t a, std::size_t b) {
        return session.chunkStart(a) < session.chunkStart(b);
      });
      TimeNs latest = 0;
      for (const std::size_t chunk : images.chunks)
        images.latest.push_back(latest = std::max(latest, session.chunkEnd(chunk)));
    }
  }
}

TimeNs PictureFinder::load(CameraId camera, TimeNs oldest, TimeNs newest, TimeNs shown,
                           CameraPicture& picture) {
  const Images& images = ofCamera(camera);
  auto chunk = std::upper_bound(images.chunks.begin(), images.chunks.end(), newest,
                                [&](TimeNs at, std::size_t c) { return at < session_.chunkStart(c); });
  TimeNs found = -1;
  std::string payload;
  // Backwards through those that began by then, until no earlier one can hold a newer image: cameras share
  // chunks, and one of them may have waited for the disk.
  while (chunk != images.chunks.begin()) {
    --chunk;
    if (images.latest[static_cast<std::size_t>(chunk - images.chunks.begin())] < std::max(oldest, found))
      break;
    session_.readChunk(*chunk, {{images.channel}, std::max<TimeNs>(0, oldest), newest},
                       [&](const McapMessage& message) {
                         if (message.log_time < found) return;
                         found = message.log_time;
                         payload = message.payload;
                       });
  }
  if (found < 0 || found == shown) return found;
  try {
    BgrImage image = images.compressed ? decodeCompressedImage(payload) : decodeImage(payload);
    picture.width = image.width;
    picture.height = image.height;
    picture.bgr = std::move(image.pixels);
    return found;
  } catch (const CutShort&) {
    return shown;
  }
}

void drawDiscs(const Observation& observation, int width, int height, CameraPicture& picture) {
  picture.width = width;
  picture.height = height;
  picture.bgr.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < picture.bgr.size(); i += kPaper.size())
    std::copy(kPaper.begin(), kPaper.end(), &picture.bgr[i]);
  for (int i = 0; i < observation.count; ++i) {
    const Centroid& centroid = observation.centroids[static_cast<std::size_t>(i)];
    fillDisc(picture, centroid.pixel, std::max(kSmallestDisc, centroid.radius_px));
  }
}

}  // namespace helical
