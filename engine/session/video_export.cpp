#include "engine/session/video_export.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "engine/base/error.h"
#include "engine/session/film_writer.h"
#include "engine/session/flight_playback.h"

namespace helical {
namespace {

constexpr int kSubpixelBits = 4;
const cv::Scalar kFound(60, 220, 255), kUsed(90, 230, 90), kExpected(255, 160, 60), kPaper(255, 255, 255);

cv::Point fine(const Eigen::Vector2d& pixel) {
  constexpr double kScale = 1 << kSubpixelBits;
  return {cvRound(kScale * pixel.x()), cvRound(kScale * pixel.y())};
}

void drawFound(cv::Mat& image, const Observation& observation) {
  for (int i = 0; i < observation.count; ++i) {
    const Centroid& centroid = observation.centroids[static_cast<std::size_t>(i)];
    cv::circle(image, fine(centroid.pixel), cvRound((centroid.radius_px + 2.0) * (1 << kSubpixelBits)),
               kFound, 1, cv::LINE_AA, kSubpixelBits);
  }
}

void drawMarkers(cv::Mat& image, const CameraTrack& track, int markers) {
  for (int m = 0; m < markers; ++m) {
    const MarkerTrack& marker = track.markers[static_cast<std::size_t>(m)];
    if (marker.predicted)
      cv::drawMarker(image, {cvRound(marker.reprojected.x()), cvRound(marker.reprojected.y())}, kExpected,
                     cv::MARKER_CROSS, 9, 1, cv::LINE_AA);
    if (!marker.observed) continue;
    cv::putText(image, std::to_string(m + 1), {cvRound(marker.pixel.x()) + 9, cvRound(marker.pixel.y()) - 7},
                cv::FONT_HERSHEY_SIMPLEX, 0.45, marker.selected ? kUsed : kFound, 1, cv::LINE_AA);
  }
}

void drawLine(cv::Mat& image, const std::string& camera, const EngineSnapshot& now) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%s   %.2f s   %s", camera.c_str(), toSeconds(now.time),
                toString(now.phase));
  const cv::Point at(8, image.rows - 10);
  cv::putText(image, text.data(), at, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar(0, 0, 0), 3, cv::LINE_AA);
  cv::putText(image, text.data(), at, cv::FONT_HERSHEY_SIMPLEX, 0.5, kPaper, 1, cv::LINE_AA);
}

/// One camera's film.
class Film {
 public:
  Film(std::filesystem::path file, CameraId camera, std::string name)
      : writer_(std::make_unique<FilmWriter>(std::move(file))), camera_(camera), name_(std::move(name)) {}

  void add(FlightPlayback& playback) {
    playback.pollPicture(camera_);
    const CameraPicture& picture = playback.picture(camera_);
    if (picture.bgr.empty()) return;  // it has not begun yet
    cv::Mat image(picture.height, picture.width, CV_8UC3);
    std::copy(picture.bgr.begin(), picture.bgr.end(), image.data);
    const EngineSnapshot& now = playback.snapshot();
    drawFound(image, picture.observation);
    drawMarkers(image, now.cameras[static_cast<std::size_t>(camera_.index())].track, now.marker_count);
    drawLine(image, name_, now);
    writer_->add(image.data, image.cols, image.rows, image.step);
  }
  FilmWriter& writer() { return *writer_; }

 private:
  std::unique_ptr<FilmWriter> writer_;
  CameraId camera_;
  std::string name_;
};

std::string wordOf(const std::string& label) {
  std::string word = label;
  for (char& letter : word)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  return word;
}

}  // namespace

VideoExport exportVideo(const std::filesystem::path& session, const std::filesystem::path& folder,
                        const ExportProgress& progress, const ExportSpan& span) {
  FlightPlayback playback(session, std::make_shared<ManualClock>());
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ErrorKind::kInput, "the folder for the export cannot be made: " + failure.message(),
                folder.string(), "choose a folder that can be written to");
  VideoExport result;
  std::vector<Film> films;
  const RigConfig& rig = playback.rig();
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraId camera = cameraId(static_cast<int>(i));
    if (playback.hasImages(camera))
      films.emplace_back(folder / ("camera_" + wordOf(rig.cameras[i].label) + ".mp4"), camera,
                         rig.cameras[i].name);
    else
      result.without_images.push_back(rig.cameras[i].label);
  }
  if (films.empty())
    throw Error(ErrorKind::kInput, "the session holds no images to make a film of", session.string(),
                "record them: helical fly --session-images jpeg");
  const TimeNs period = fromSeconds(1.0 / FilmWriter::kPicturesPerSecond);
  const TimeNs begin = std::max(playback.begin(), span.from), end = std::min(playback.end(), span.to);
  for (TimeNs now = begin; now <= end; now += period) {
    progress(static_cast<double>(now - begin) / static_cast<double>(std::max<TimeNs>(1, end - begin)));
    playback.seek(now);
    for (Film& film : films) film.add(playback);
  }
  for (Film& film : films) {
    if (!film.writer().begun()) continue;
    film.writer().finish();
    result.files.push_back(film.writer().file());
  }
  return result;
}

}  // namespace helical
