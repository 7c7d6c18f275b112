#include "engine/session/film_writer.h"

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <system_error>
#include <utility>

#include "engine/base/error.h"

namespace helical {

struct FilmWriter::Encoder {
  cv::VideoWriter writer;
  cv::Size size;
};

FilmWriter::FilmWriter(std::filesystem::path file)
    : file_(std::move(file)), encoder_(std::make_unique<Encoder>()) {}

FilmWriter::~FilmWriter() {
  if (finished_ || !begun()) return;
  encoder_->writer.release();
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

bool FilmWriter::begun() const {
  return encoder_->writer.isOpened();
}

void FilmWriter::add(const std::uint8_t* bgr, int width, int height, std::size_t stride) {
  // Codings halve the colours' resolution: what is odd loses its last row or column.
  const cv::Size size(width / 2 * 2, height / 2 * 2);
  if (!begun()) {
    encoder_->size = size;
    for (const char* coding : {"avc1", "mp4v"}) {
      const int code = cv::VideoWriter::fourcc(coding[0], coding[1], coding[2], coding[3]);
      if (encoder_->writer.open(file_.string(), cv::CAP_FFMPEG, code, kPicturesPerSecond, size)) break;
    }
    if (!begun())
      throw Error(ErrorKind::kSystem, "the film cannot be written", file_.string(),
                  "choose a folder that can be written to; OpenCV needs FFmpeg (libopencv-videoio)");
  }
  if (size != encoder_->size) return;
  // OpenCV has no matrix of constant pixels; nobody writes to this one.
  encoder_->writer.write(cv::Mat(size, CV_8UC3, const_cast<std::uint8_t*>(bgr), stride));
}

void FilmWriter::finish() {
  encoder_->writer.release();
  finished_ = true;
}

}  // namespace helical
