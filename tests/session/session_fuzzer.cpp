#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/session/session_exercise.h"

/// libFuzzer's door to everything that reads sessions; seeds are real sessions. Built where the compiler is
/// clang: -DHELICAL_FUZZ=ON; then `build/NAME/tests/session_fuzzer SEEDS`.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path scratch = [] {
    std::string name = (std::filesystem::temp_directory_path() / "helical-fuzz-XXXXXX").string();
    return std::filesystem::path(::mkdtemp(name.data()));
  }();
  const int file = ::memfd_create("session", MFD_CLOEXEC);
  if (file < 0 || ::write(file, data, size) != static_cast<ssize_t>(size)) return 0;
  helical::test::exerciseSession("/proc/self/fd/" + std::to_string(file), scratch);
  ::close(file);
  return 0;
}
