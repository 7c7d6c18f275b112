#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace helical {

class VideoFilm;

/// Writes one MP4 film, 30 pictures a second, in the best coding that this machine has. Begins with the first
/// picture, whose size all have. A film that is not finished is gone with this. One thread; throws
/// Error(kSystem) where it cannot be written.
class FilmWriter {
 public:
  static constexpr double kPicturesPerSecond = 30.0;

  explicit FilmWriter(std::filesystem::path file);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// Rows of blue, green, red, `stride` bytes apart.
  void add(const std::uint8_t* bgr, int width, int height, std::size_t stride);
  bool begun() const;
  void finish();
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::unique_ptr<VideoFilm> film_;  ///< begun
  int width_ = 0;
  int height_ = 0;
  bool finished_ = false;
};

}  // namespace helical
