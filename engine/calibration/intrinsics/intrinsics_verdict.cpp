#include "engine/calibration/intrinsics/intrinsics_verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace helical {
namespace {

// Residuals [share of the image's width]: 0.8 and 2.5 px at 640.
constexpr double kGoodRms = 0.00125, kUsableRms = 0.004;
// Of the focal length, and of the centre over the focal length.
constexpr double kGoodSigma = 0.005, kUsableSigma = 0.03;
constexpr double kGoodTiltDeg = 20.0, kUsableTiltDeg = 6.0;
constexpr int kGoodViews = 8, kUsableViews = 4;
constexpr std::size_t kGoodUncovered = 2;
constexpr double kLikelyCentre = 0.2;  // of the image's size, from its middle

std::string number(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

class Judge {
 public:
  explicit Judge(IntrinsicsCalibration& calibration) : calibration_(calibration) {
    calibration.verdict = IntrinsicsVerdict::kGood;
  }

  /// Not a number is bad, too.
  void limit(double value, double good, double usable, const std::string& reason) {
    if (value <= good) return;
    reasonFor(value <= usable ? IntrinsicsVerdict::kUsable : IntrinsicsVerdict::kBad, reason);
  }

  void reasonFor(IntrinsicsVerdict verdict, const std::string& reason) {
    calibration_.verdict = std::max(calibration_.verdict, verdict);
    calibration_.reasons.push_back(reason);
  }

 private:
  IntrinsicsCalibration& calibration_;
};

}  // namespace

void judge(IntrinsicsCalibration& c) {
  Judge judge(c);
  const int used =
      static_cast<int>(std::count_if(c.views.begin(), c.views.end(), [](const auto& v) { return v.used; }));
  judge.limit(-used, -kGoodViews, -kUsableViews, std::to_string(used) + " views: take 15 to 30");
  judge.limit(-c.tilt_deg, -kGoodTiltDeg, -kUsableTiltDeg,
              "all views are nearly parallel (within " + number(c.tilt_deg, 1) +
                  " degrees), which leaves the focal length open: tilt the board by 30 degrees and more, to "
                  "all sides");
  judge.limit(
      c.rms_px / c.model.width(), kGoodRms, kUsableRms,
      "the corners miss by " + number(c.rms_px, 2) +
          " px rms: see to focus, motion blur and a flat board; for a wide-angle lens try --rational");
  const double focal = std::max(c.sigma[0] / c.model.fx(), c.sigma[1] / c.model.fy());
  judge.limit(
      focal, kGoodSigma, kUsableSigma,
      "the focal length is known to " + number(100.0 * focal, 2) + " % only: more views, tilted and near");
  const double centre = std::max(c.sigma[2] / c.model.fx(), c.sigma[3] / c.model.fy());
  judge.limit(
      centre, kGoodSigma, kUsableSigma,
      "the image centre is known to " + number(100.0 * centre, 2) + " % of the focal length only: tilt more");
  const double off = std::max(std::abs(c.model.cx() / c.model.width() - 0.5),
                              std::abs(c.model.cy() / c.model.height() - 0.5));
  judge.limit(off, kLikelyCentre, 1e9,
              "the image centre is far off the middle: was the image cut, or turned?");
  if (c.uncovered.size() > kGoodUncovered) {
    std::string parts;
    for (const std::string& part : c.uncovered) parts += (parts.empty() ? "" : ", ") + part;
    judge.reasonFor(IntrinsicsVerdict::kUsable,
                    "no corners in these parts of the image, where distortion is a guess: " + parts +
                        "; hold the board there, too");
  }
}

const char* nameOf(IntrinsicsVerdict verdict) {
  switch (verdict) {
    case IntrinsicsVerdict::kGood:
      return "good";
    case IntrinsicsVerdict::kUsable:
      return "usable";
    case IntrinsicsVerdict::kBad:
      return "bad";
  }
  return "";
}

}  // namespace helical
