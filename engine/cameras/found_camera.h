#pragma once

#include <string>
#include <vector>

namespace helical {

/// A camera that is plugged in, and what it offers.
struct FoundCamera {
  std::string source;  ///< as a rig file names it: "aravis:127.0.0.2"
  std::string name;    ///< vendor and model
  std::string serial;
  std::string kind;    ///< "GigE Vision", "USB3 Vision", "webcam"
  std::string owner;   ///< "free", "controlled by another host or program", or why it cannot be opened
  int width = 0;       ///< largest [px]; 0: not told
  int height = 0;
  std::vector<std::string> formats;
  double lowest_rate_hz = 0.0;  ///< 0: not told
  double highest_rate_hz = 0.0;
};

}  // namespace helical
