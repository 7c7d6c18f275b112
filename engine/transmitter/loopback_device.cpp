#include "engine/transmitter/loopback_device.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "engine/base/error.h"

namespace helical {

LoopbackDevice::LoopbackDevice(const std::string& log) {
  if (log.empty()) return;
  file_ = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file_ < 0)
    throw Error(ErrorKind::kDevice,
                std::string("the loopback's log cannot be written: ") + std::strerror(errno), log,
                "give a file in a folder that exists");
}

LoopbackDevice::~LoopbackDevice() {
  if (file_ >= 0) close(file_);
}

void LoopbackDevice::send(const StickDemand& demand, TimeNs now) {
  if (file_ < 0) return;
  std::array<char, 160> line;
  const int length =
      std::snprintf(line.data(), line.size(), "%lld %.6f %.6f %.6f %.6f %d\n", static_cast<long long>(now),
                    demand.upper_rotor, demand.lower_rotor, demand.roll, demand.pitch, level_ ? 1 : 0);
  status_.fault = write(file_, line.data(), static_cast<std::size_t>(length)) != length;
}

}  // namespace helical
