#include "engine/session/session_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>

#include "engine/base/error.h"
#include "engine/session/mcap_format.h"

namespace helical {
namespace {

constexpr const char* kSuffix = ".mcap";

/// Ends otherwise than every closed file does, and no process has its lock: see McapWriter.
bool isCutOff(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  std::array<char, kMcapMagic.size()> end{};
  struct stat status {};
  const bool read =
      ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
      status.st_size >= static_cast<off_t>(2 * end.size()) &&
      ::pread(descriptor, end.data(), end.size(), status.st_size - static_cast<off_t>(end.size())) ==
          static_cast<ssize_t>(end.size());
  const bool free = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0;
  ::close(descriptor);
  return read && free && std::string_view(end.data(), end.size()) != kMcapMagic;
}

}  // namespace

std::filesystem::path sessionFolder() {
  const char* data = std::getenv("XDG_DATA_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder = ".";
  if (data != nullptr && *data == '/')  // others are to be ignored, says the XDG specification
    folder = data;
  else if (home != nullptr && *home != '\0')
    folder = std::filesystem::path(home) / ".local" / "share";
  return folder / "helical" / "sessions";
}

std::filesystem::path newSessionFile(const std::filesystem::path& folder, const std::string& rig_file,
                                     std::chrono::system_clock::time_point begin) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ErrorKind::kSystem, "the folder for sessions cannot be made: " + failure.message(),
                folder.string(), "name another one in XDG_DATA_HOME");
  const std::time_t seconds = std::chrono::system_clock::to_time_t(begin);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> time{};
  std::strftime(time.data(), time.size(), "%Y-%m-%dT%H-%M-%S", &parts);
  const std::string name = std::string(time.data()) + "_" + std::filesystem::path(rig_file).stem().string();
  std::filesystem::path file = folder / (name + kSuffix);
  for (int i = 2; std::filesystem::exists(file); ++i)
    file = folder / (name + "_" + std::to_string(i) + kSuffix);
  return file;
}

std::vector<std::filesystem::path> cutOffSessions(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure))
    if (entry->path().extension() == kSuffix && isCutOff(entry->path())) files.push_back(entry->path());
  std::sort(files.rbegin(), files.rend());
  return files;
}

}  // namespace helical
