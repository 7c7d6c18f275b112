// helical-output: owns the transmitter's device and outlives the ground station; see engine/transmitter.

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "engine/base/error.h"
#include "engine/transmitter/output_main.h"

int main(int argc, char** argv) {
  char* end = nullptr;
  const long descriptor = argc == 2 ? std::strtol(argv[1], &end, 10) : -1;
  if (descriptor < 0 || end == argv[1] || *end != '\0') {
    std::fputs("helical-output is started by helical, which gives it the memory that both share\n", stderr);
    return 2;
  }
  try {
    helical::runOutput(static_cast<int>(descriptor));
    return 0;
  } catch (const helical::Error& error) {
    std::fprintf(stderr, "helical-output: %s\n", error.what());
    return error.kind() == helical::ErrorKind::kDevice ? 3 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "helical-output: %s\n", error.what());
    return 1;
  }
}
