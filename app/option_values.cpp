#include "app/option_values.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

/// Reads values between literal separators from left to right.
class Scanner {
 public:
  Scanner(std::string_view text, std::string_view option, std::string_view form)
      : text_(text), rest_(text), option_(option), form_(form) {}

  std::string label(char end) {
    const std::size_t at = rest_.rfind(end);  // labels may hold any character; the last separator counts
    if (at == std::string_view::npos || at == 0) fail();
    std::string result(rest_.substr(0, at));
    rest_.remove_prefix(at + 1);
    return result;
  }

  double number(char end = '\0') {
    double value = 0.0;
    const auto [next, code] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (code != std::errc()) fail();
    rest_.remove_prefix(static_cast<std::size_t>(next - rest_.data()));
    if (end == '\0') {
      if (!rest_.empty()) fail();
    } else {
      if (rest_.empty() || rest_.front() != end) fail();
      rest_.remove_prefix(1);
    }
    return value;
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(ErrorKind::kInput, std::string(option_) + " " + std::string(text_) + " is not understood", {},
                "give " + std::string(form_));
  }

  std::string_view text_;
  std::string_view rest_;
  std::string_view option_;
  std::string_view form_;
};

ImageRecording parseImageRecording(const std::string& text) {
  ImageRecording recording;
  const std::string word = text.substr(0, text.find('@'));
  if (word == "jpeg")
    recording.quality = ImageQuality::kJpeg;
  else if (word == "lossless")
    recording.quality = ImageQuality::kLossless;
  const std::string form = "[CAM=]off|jpeg|lossless[@HZ], as in jpeg or 2=lossless@10";
  if (word.size() < text.size()) {
    Scanner scanner(text, "--session-images", form);
    scanner.label('@');
    recording.rate_hz = scanner.number();
  }
  if ((recording.quality == ImageQuality::kOff && word != "off") || !(recording.rate_hz >= 0.0))
    throw Error(ErrorKind::kInput, "--session-images " + text + " is not understood", {}, "give " + form);
  return recording;
}

}  // namespace

Occlusion parseOcclusion(const std::string& text, const RigConfig& rig) {
  Scanner scanner(text, "--occlude", "CAM@FROM-TO, as in 2@13-25 (seconds)");
  Occlusion occlusion;
  occlusion.camera = rig.camera(scanner.label('@'));
  occlusion.from_s = scanner.number('-');
  occlusion.to_s = scanner.number();
  return occlusion;
}

Bump parseBump(const std::string& text, const RigConfig& rig) {
  Scanner scanner(text, "--bump", "CAM@T:DEG,M, as in 3@10:5,0.05 (seconds, degrees, metres)");
  Bump bump;
  bump.camera = rig.camera(scanner.label('@'));
  bump.at_s = scanner.number(':');
  bump.angle = toRadians(scanner.number(','));
  bump.distance = scanner.number();
  return bump;
}

std::vector<ImageRecording> parseImageRecordings(const std::vector<std::string>& texts,
                                                 const RigConfig& rig) {
  std::vector<ImageRecording> images(rig.cameras.size());
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const std::string form = equals == std::string::npos ? text : text.substr(equals + 1);
    const ImageRecording recording = parseImageRecording(form);
    if (equals == std::string::npos)
      std::fill(images.begin(), images.end(), recording);
    else
      images[static_cast<std::size_t>(rig.camera(text.substr(0, equals)).index())] = recording;
  }
  return images;
}

ScheduledFault parseFault(const std::string& text, ScheduledFault::Kind kind, const std::string& option,
                          const RigConfig& rig) {
  const bool clock = kind == ScheduledFault::Kind::kClock;
  const bool valued = clock || kind == ScheduledFault::Kind::kLoss || kind == ScheduledFault::Kind::kJitter;
  const std::string form = std::string("CAM@FROM-TO") + (clock ? ":S,PPM" : valued ? ":VALUE" : "") + ", as in 2@8-11" +
                           (clock ? ":0.02,50" : valued ? ":0.01" : "");
  Scanner scanner(text, option, form);
  ScheduledFault fault;
  fault.kind = kind;
  fault.camera = static_cast<std::size_t>(rig.camera(scanner.label('@')).index());
  fault.from_s = scanner.number('-');
  fault.to_s = valued ? scanner.number(':') : scanner.number();
  if (valued) fault.value = clock ? scanner.number(',') : scanner.number();
  if (clock) fault.drift = 1e-6 * scanner.number();
  const bool share = kind == ScheduledFault::Kind::kLoss;
  if (!(fault.to_s > fault.from_s) || (!clock && fault.value < 0.0) || (share && fault.value > 1.0))
    throw Error(ErrorKind::kInput, option + " " + text + " cannot be", {}, "give " + form);
  return fault;
}

}  // namespace helical
