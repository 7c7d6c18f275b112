#include "engine/session/film_writer.h"

#include <system_error>
#include <utility>

#include "engine/base/error.h"
#include "engine/cameras/video/video_film.h"

namespace helical {

FilmWriter::FilmWriter(std::filesystem::path file) : file_(std::move(file)) {}

FilmWriter::~FilmWriter() {
  if (finished_ || !begun()) return;
  film_.reset();
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

bool FilmWriter::begun() const {
  return film_ != nullptr;
}

void FilmWriter::add(const std::uint8_t* bgr, int width, int height, std::size_t stride) {
  // Codings halve the colours' resolution: what is odd loses its last row or column.
  width = width / 2 * 2;
  height = height / 2 * 2;
  if (!begun()) {
    for (const char* coding : {"avc1", "mp4v"}) {
      auto film = makeVideoFilm();
      if (!film->open(file_.string(), coding, kPicturesPerSecond, width, height)) continue;
      film_ = std::move(film);
      break;
    }
    width_ = width;
    height_ = height;
    if (!begun())
      throw Error(ErrorKind::kSystem, "the film cannot be written", file_.string(),
                  "choose a folder that can be written to; OpenCV needs FFmpeg (libopencv-videoio)");
  }
  if (width != width_ || height != height_) return;
  film_->write({bgr, width, height, static_cast<int>(stride), PixelFormat::kBgr8});
}

void FilmWriter::finish() {
  film_.reset();
  finished_ = true;
}

}  // namespace helical
