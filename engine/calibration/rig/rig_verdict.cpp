#include "engine/calibration/rig/rig_verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/calibration/rig/rig_solution.h"

namespace helical {
namespace {

// Residuals [share of the image's width]: 1.6 and 5 px at 640.
constexpr double kGoodRms = 0.0025, kUsableRms = 0.008;
// Standard deviation of a camera's place over its distance to what it saw.
constexpr double kGoodPlace = 0.005, kUsablePlace = 0.03;
constexpr double kGoodRejected = 0.15, kUsableRejected = 0.5;
// Where hardly anything lies just beyond the gate, what was rejected is something else than the target.
constexpr double kUsableSomethingElse = 0.75;
constexpr long kGoodObservations = 60, kUsableObservations = 20;
constexpr int kGoodParts = 4;       // of 16
constexpr double kFarSigmas = 4.0;  // of a prior
constexpr double kSurelyOff = 6.0;  // standard deviations of a focal length
constexpr double kGoodGivenDeg = 0.5, kUsableGivenDeg = 2.0;
constexpr double kGoodGivenShare = 0.01, kUsableGivenShare = 0.05;

std::string number(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

class Judge {
 public:
  explicit Judge(RigCalibration& calibration) : calibration_(calibration) {
    calibration.verdict = RigVerdict::kGood;
  }

  /// The worse of the verdict so far and what `value` deserves by two limits.
  void limit(double value, double good, double usable, const std::string& reason) {
    if (value <= good) return;
    reasonFor(value <= usable ? RigVerdict::kUsable : RigVerdict::kBad, reason);
  }

  void reasonFor(RigVerdict verdict, const std::string& reason) {
    calibration_.verdict = std::max(calibration_.verdict, verdict);
    calibration_.reasons.push_back(reason);
  }

 private:
  RigCalibration& calibration_;
};

/// Where something is this far off, its prior was too narrow, or it makes up for something else that is
/// wrong.
void judgeSelf(Judge& judge, const RigCalibration& calibration) {
  for (const CalibratedCamera& c : calibration.cameras)
    if (std::abs(c.focal_scale - 1.0) > kFarSigmas * calibration.self.focal_sigma && c.focal_scale != 1.0)
      judge.reasonFor(RigVerdict::kUsable,
                      "the focal length of camera " + c.label + " came out " +
                          number(100.0 * (c.focal_scale - 1.0), 2) +
                          " % off, more than --refine-focal expects: calibrate its intrinsics");
  double farthest = 0.0;
  for (const CalibratedPoint& p : calibration.points)
    farthest = std::max(farthest, (p.found - p.given).cwiseAbs().maxCoeff());
  if (!calibration.points.empty() && farthest > kFarSigmas * calibration.self.marker_sigma_m)
    judge.reasonFor(RigVerdict::kUsable,
                    "a point of the body came out " + number(1e3 * farthest, 1) +
                        " mm off, more than --refine-markers expects: see to the body coordinates");
}

/// Focal lengths that are wrong move cameras by much and residuals by little.
void judgeFocals(Judge& judge, const RigCalibration& calibration) {
  const CalibratedCamera* surest = nullptr;
  double most = kSurelyOff;
  for (const CalibratedCamera& c : calibration.cameras) {
    if (!(c.focal_off_sigma > 0.0) || std::abs(c.focal_off) <= most * c.focal_off_sigma) continue;
    most = std::abs(c.focal_off) / c.focal_off_sigma;
    surest = &c;
  }
  if (surest == nullptr) return;
  // Whether it is the focal lengths or something else of the lens is not known: never worse than usable.
  if (calibration.focal_share > kGoodPlace)
    judge.reasonFor(
        RigVerdict::kUsable,
        "the recording contradicts the given intrinsics: with focal lengths that fit it (camera " +
            surest->label + "'s " + number(100.0 * surest->focal_off, 2) +
            " % off) cameras would stand elsewhere by up to " + number(100.0 * calibration.focal_share, 1) +
            " % of their distance: calibrate the intrinsics");
}

void judgeCamera(Judge& judge, const CalibratedCamera& c, const RigCamera& camera, bool metric) {
  const std::string who = "camera " + c.label;
  if (c.observations == 0 && !c.given)
    return judge.reasonFor(RigVerdict::kBad,
                           who +
                               " shares no observation with another camera: record with the target "
                               "where it and another one see it at once");
  if (!c.camera_from_world)
    return judge.reasonFor(
        RigVerdict::kBad,
        who +
            " cannot be placed: too few of its observations agree with those of placed cameras; "
            "record with the target where it and two others see it at once");
  if (c.observations == 0) return;  // a given camera that saw nothing harms nothing
  const long inliers = c.observations - c.rejected;
  judge.limit(static_cast<double>(-inliers), -kGoodObservations, -kUsableObservations,
              who + " has " + std::to_string(inliers) + " good observations only: record more");
  if (c.moved)
    judge.reasonFor(
        c.moved->fits_before ? RigVerdict::kBad : RigVerdict::kUsable,
        who + " fits the others only " + (c.moved->fits_before ? "before " : "from ") +
            number(c.moved->at_s, 1) + " s" + (c.moved->fits_before ? "" : " on") +
            ": it was moved then, or its rows are another camera's; calibrate by what was recorded " +
            (c.moved->fits_before ? "after that" : "since"));
  else
    judge.limit(
        static_cast<double>(c.rejected) / static_cast<double>(c.observations), kGoodRejected,
        c.near_misses < kFewNearMisses ? kUsableSomethingElse : kUsableRejected,
        std::to_string(c.rejected) + " of " + std::to_string(c.observations) + " observations of " + who +
            " were rejected: something else than the target was seen, its intrinsics are wrong, or its time "
            "stamps are more than a frame off");
  judge.limit(c.reprojection_rms_px / camera.model.width(), kGoodRms, kUsableRms,
              who + " misses by " + number(c.reprojection_rms_px, 2) +
                  " px rms: see to its intrinsics, its focus, and that clocks and columns are right");
  if (c.beyond_reach)
    judge.reasonFor(RigVerdict::kUsable,
                    who +
                        " saw more than a frame later or earlier than its time stamps say: "
                        "correct them, or trigger the cameras together");
  if (c.image_parts < kGoodParts)
    judge.reasonFor(RigVerdict::kUsable,
                    who + " saw the target in " + std::to_string(c.image_parts) +
                        " of 16 parts of its image only: move it through the whole image");
  if (c.given) return;
  if (!c.covariance)
    return judge.reasonFor(RigVerdict::kBad, "the recording leaves the place of " + who +
                                                 " open: move the target in depth and sideways");
  judge.limit(
      c.position_sigma_m / std::max(1e-9, c.distance_m), kGoodPlace, kUsablePlace,
      who + "'s place is known to " + number(100.0 * c.position_sigma_m / std::max(1e-9, c.distance_m), 1) +
          " % of its distance only" + (metric ? " (" + number(1e3 * c.position_sigma_m, 1) + " mm)" : "") +
          ": record longer and through more of the space");
}

}  // namespace

void judge(RigCalibration& calibration, std::span<const RigCamera> cameras) {
  Judge judge(calibration);
  for (std::size_t i = 0; i < cameras.size(); ++i)
    judgeCamera(judge, calibration.cameras[i], cameras[i], calibration.metric);
  if (calibration.along_a_line)
    judge.reasonFor(
        RigVerdict::kBad,
        "the target moved along a line, which many camera poses explain: move it through the whole "
        "space");
  judgeFocals(judge, calibration);
  judgeSelf(judge, calibration);
  const std::string off = "the given poses disagree with the recording by " +
                          number(calibration.given_off_deg, 2) + " degrees and " +
                          number(100.0 * calibration.given_off_share, 1) + " % of the distance";
  const std::string cure = ": remove [camera.pose] of the one that was moved";
  if (calibration.given_off_deg > kGoodGivenDeg || calibration.given_off_share > kGoodGivenShare)
    judge.reasonFor(
        calibration.given_off_deg > kUsableGivenDeg || calibration.given_off_share > kUsableGivenShare
            ? RigVerdict::kBad
            : RigVerdict::kUsable,
        off + cure);
}

const char* nameOf(RigVerdict verdict) {
  switch (verdict) {
    case RigVerdict::kGood:
      return "good";
    case RigVerdict::kUsable:
      return "usable";
    case RigVerdict::kBad:
      return "bad";
  }
  return "";
}

}  // namespace helical
