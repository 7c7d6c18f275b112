// A ground station for tests, to be killed and stopped: flies (the same sticks for ever) through the output
// process. Usage: ground_station OUTPUT_PROGRAM LOG, or ground_station OUTPUT_PROGRAM SERIAL DEVICE

#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

#include "engine/transmitter/output_process.h"

namespace {

constexpr helical::StickAxis kSticks[] = {helical::StickAxis::kUpperRotor, helical::StickAxis::kLowerRotor,
                                          helical::StickAxis::kRoll, helical::StickAxis::kPitch};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) return 2;
  helical::OutputSettings settings;
  std::strncpy(settings.device.data(), argc == 4 ? argv[3] : "loopback", settings.device.size() - 1);
  std::strncpy(settings.address.data(), argv[2], settings.address.size() - 1);
  if (argc == 4) {
    settings.channels.count = 4;
    for (int i = 0; i < 4; ++i) settings.channels.all[static_cast<std::size_t>(i)] = {kSticks[i], i, 0.5, 2.5, 4.5, 0.0, false, 0.0};
    settings.directions_checked = true;
  }
  settings.guard.hold_s = 0.1;
  settings.guard.ramp_per_s = 4.0;
  helical::OutputProcess output(settings, argv[1]);
  std::printf("%d\n", output.pid());
  std::fflush(stdout);
  for (bool flies = false;;) {
    // At rest until it is heard, and from then on as if nothing ever happened.
    flies = flies || (output.report().sequence > 0 && !output.report().locked);
    output.send(flies ? helical::StickDemand{0.5, 0.55, 0.2, -0.3} : helical::StickDemand{}, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}
