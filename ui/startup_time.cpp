#include "ui/startup_time.h"

#include <unistd.h>

#include <ctime>
#include <fstream>
#include <sstream>
#include <string>

namespace helical {

std::optional<TimeNs> sinceProcessStart() {
  std::ifstream file("/proc/self/stat");
  std::string text;
  std::getline(file, text);
  // The second field is the program's name in brackets and may hold spaces; starttime is field 22.
  const auto name_end = text.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(name_end + 1));
  std::string skipped;
  for (int field = 3; field < 22; ++field) fields >> skipped;
  std::int64_t start_ticks = 0;
  if (!(fields >> start_ticks)) return std::nullopt;

  timespec now{};
  if (clock_gettime(CLOCK_BOOTTIME, &now) != 0) return std::nullopt;
  const TimeNs per_tick = kNanosecondsPerSecond / sysconf(_SC_CLK_TCK);
  return now.tv_sec * kNanosecondsPerSecond + now.tv_nsec - start_ticks * per_tick;
}

}  // namespace helical
