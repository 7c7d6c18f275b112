#include "engine/config/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "engine/base/error.h"

namespace helical {
namespace {

// Far more than a rig of kMaxCameras cameras needs; keeps /dev/zero and a mistaken video out of memory.
constexpr std::size_t kLargestFile = 1 << 20;

}  // namespace

std::string readTextFile(const std::filesystem::path& file, const std::string& what_it_is) {
  const std::string where = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(ErrorKind::kInput, "this is a folder, not a " + what_it_is, where, "name the file inside it");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    const std::string reason = std::strerror(errno == 0 ? EIO : errno);
    throw Error(ErrorKind::kInput, "cannot read the " + what_it_is + ": " + reason, where,
                "check the path and that you may read it");
  }
  std::string text(kLargestFile + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad())
    throw Error(ErrorKind::kInput, "reading the " + what_it_is + " failed", where, "check the disk");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kLargestFile)
    throw Error(ErrorKind::kInput, "larger than 1 MiB: this is no " + what_it_is, where,
                "name a " + what_it_is);
  return text;
}

}  // namespace helical
