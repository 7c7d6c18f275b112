#include <dlfcn.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/cameras/video/video_capture.h"
#include "engine/cameras/video/video_film.h"

namespace helical {
namespace {

/// OpenCV's part for videos needs some hundred libraries more than the rest of Helical: only who sees a video pays.
void* loadLibrary() {
  std::error_code failure;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", failure).parent_path();
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);              // our errors say it better
  setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "1", 0);    // s; ten by default
  std::string reason = "it is missing";
  for (const auto& folder : {here, here.parent_path() / "bin"}) {
    const auto file = folder / "helical-video.so";
    if (!std::filesystem::exists(file, failure)) continue;
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) return library;
    const char* const text = dlerror();
    if (text != nullptr) reason = text;
  }
  throw Error(ErrorKind::kSystem, "the library for videos and webcams cannot be loaded: " + reason, here.string(),
              "build Helical anew: ./app/run --build-only");
}

template <class T>
std::unique_ptr<T> make(const char* maker) {
  static void* const library = loadLibrary();
  void* const function = dlsym(library, maker);
  HELICAL_CHECK(function != nullptr);
  return std::unique_ptr<T>(reinterpret_cast<T* (*)()>(function)());
}

}  // namespace

double toFourCc(const std::string& name) {
  std::uint32_t code = 0;
  for (std::size_t i = 4; i-- > 0;) code = code << 8 | (i < name.size() ? static_cast<std::uint8_t>(name[i]) : ' ');
  return code;
}

std::string nameOfFourCc(double code) {
  std::string name;
  for (unsigned shift = 0; shift < 32; shift += 8)
    name += static_cast<char>(static_cast<std::uint32_t>(code) >> shift & 0x7f);
  return name;
}

std::unique_ptr<VideoCapture> makeVideoCapture() {
  return make<VideoCapture>("helicalMakeVideoCapture");
}

std::unique_ptr<VideoFilm> makeVideoFilm() {
  return make<VideoFilm>("helicalMakeVideoFilm");
}

}  // namespace helical
