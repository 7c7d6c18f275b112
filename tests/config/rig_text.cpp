#include "tests/config/rig_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace helical {

std::string goodRig() {
  return R"(format_version = 1

[[camera]]
id = "left"
size = [640, 480]
[camera.intrinsics]
fx = 567.6
fy = 560.1
cx = 319.5
cy = 239
distortion = [-0.05, 0.01, 0.001, -0.002, 0.003]
[camera.pose]
rotation_wxyz = [0.5, 0.5, -0.5, 0.5]
translation_m = [0.1, -0.2, 3.0]

[markers]
hue_low = 50

[simulation]
gust_factor = 0.5
)";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

int lineOf(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  EXPECT_NE(at, std::string::npos) << word;
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace helical
