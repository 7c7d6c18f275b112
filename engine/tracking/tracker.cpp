#include "engine/tracking/tracker.h"

#include <array>
#include <string>

#include "engine/base/error.h"
#include "engine/tracking/latest_images_tracker.h"
#include "engine/tracking/pixel_filter.h"

namespace helical {
namespace {

constexpr std::array<std::string_view, 2> kNames{"helical", "paper"};

}  // namespace

std::span<const std::string_view> trackerNames() {
  return kNames;
}

std::unique_ptr<Tracker> makeTracker(std::string_view name, const TrackerOptions& options,
                                     const MarkerLayout& markers, std::vector<CameraModel> cameras,
                                     double standing_height) {
  if (name == kNames[0])
    return std::make_unique<PixelFilter>(options, markers, std::move(cameras), standing_height);
  if (name == kNames[1])
    return std::make_unique<LatestImagesTracker>(markers, std::move(cameras), standing_height);
  throw Error(ErrorKind::kInput, "there is no tracker '" + std::string(name) + "'", {},
              "choose helical or paper");
}

}  // namespace helical
