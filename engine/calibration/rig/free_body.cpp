#include "engine/calibration/rig/free_body.h"

#include <map>
#include <tuple>

#include "engine/base/error.h"

namespace helical {
namespace {

constexpr std::size_t kMostBodyPoints = 150;  // a large board; each adds three unknowns

}  // namespace

FreeBody freeBody(const SightingTable& table, std::span<const RigCamera> cameras,
                  const SelfCalibrationOptions& sigmas, const std::string& file) {
  FreeBody body;
  body.sigmas = sigmas;
  std::map<std::tuple<double, double, double>, int> known;
  for (const Sighting& s : table.sightings) {
    const auto [entry, is_new] = known.emplace(std::tuple(s.in_body.x(), s.in_body.y(), s.in_body.z()),
                                               static_cast<int>(known.size()));
    if (is_new) body.given.push_back(s.in_body);
    body.point.push_back(entry->second);
  }
  if (body.given.size() > kMostBodyPoints)
    throw Error(ErrorKind::kInput,
                "the body has " + std::to_string(body.given.size()) + " different points: too many to refine",
                file,
                "give each of its points the same coordinates in all rows, at most " +
                    std::to_string(kMostBodyPoints));
  body.points = body.given;
  body.given_cameras.assign(cameras.begin(), cameras.end());
  body.focal_scales.assign(cameras.size(), 1.0);
  return body;
}

void takeOver(const FreeBody& body, SightingTable& table, std::span<RigCamera> cameras) {
  for (std::size_t i = 0; i < table.sightings.size(); ++i)
    table.sightings[i].in_body = body.points[static_cast<std::size_t>(body.point[i])];
  for (std::size_t c = 0; c < cameras.size(); ++c)
    cameras[c].model = body.given_cameras[c].model.withFocalScale(body.focal_scales[c]);
}

}  // namespace helical
