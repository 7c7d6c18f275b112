#include "engine/calibration/knock_detector.h"

#include <algorithm>

namespace helical {
namespace {

constexpr TimeNs kForgotten = 200 * kNanosecondsPerMillisecond;  // what was counted before such a gap
constexpr int kFewestInView = 3;                                 // of fewer balls two outliers are a majority
constexpr int kAgreeing = 2;  // fewer than so many balls in place: the camera disagrees

}  // namespace

bool KnockDetector::add(const KnockEvidence& evidence) {
  if (evidence.exposure - last_ > kForgotten) balance_ = 0;
  if (evidence.in_view < kFewestInView || evidence.witnesses == 0) return false;
  last_ = evidence.exposure;
  // One frame of agreement outweighs two of disagreement: a knocked camera agrees in none.
  balance_ = evidence.agreeing < kAgreeing ? balance_ + 1 : std::max(0, balance_ - 2);
  const int limit = evidence.witnesses > 1 ? options_.disagreeing_frames : options_.disagreeing_frames_of_two;
  if (balance_ < limit) return false;
  balance_ = 0;
  return true;
}

}  // namespace helical
