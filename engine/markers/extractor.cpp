#include "engine/markers/extractor.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/markers/background_model.h"
#include "engine/markers/binary_mask.h"
#include "engine/markers/disc_fit.h"
#include "engine/markers/region_finder.h"
#include "engine/markers/region_selection.h"
#include "engine/markers/search_windows.h"

namespace helical {
namespace {

/// px around everything that was found, more by half its extent, which the background does not learn from:
/// the rest of the helicopter.
constexpr int kAround = 24;

}  // namespace

struct Extractor::Workspace {
  explicit Workspace(const MarkerOptions& marker_options)
      : options(marker_options),
        background(marker_options.background_frames),
        selection(options) {
    colours.push_back(options);
    colours.insert(colours.end(), options.other_colours.begin(), options.other_colours.end());
  }

  std::vector<std::shared_ptr<const ColourClass>> classesFor(const CellGrid& grid) const;
  void resize(const ImageView& image);
  void adaptBackground(const ImageView& image);
  CellRule ruleOf(std::size_t colour) const;
  void findMarkers(const ImageView& image, Observation& observation);
  void findRegions(const CellGrid& grid, std::span<const WordRect> windows);
  void locate(const ColouredRegion& region, const CellGrid& grid, Observation& observation);
  static void add(const Centroid& centroid, Observation& observation);

  MarkerOptions options;
  std::vector<ColourRange> colours;
  std::vector<std::shared_ptr<const ColourClass>> classes;  ///< of `colours`, for `format` or the one to come
  BackgroundModel background;
  RegionFinder finder{1, 1};
  RegionSelection selection;
  SearchWindows search{0};
  BallPredictions predictions;
  int since_whole = 0;  ///< frames read by windows since one was read as a whole
  DiscFit disc_fit;
  IgnoredAreas ignored_areas;
  BinaryMask ignored;  ///< of `ignored_areas`, unless there are none
  int width = 0;
  int height = 0;
  std::optional<PixelFormat> format;
};

std::vector<std::shared_ptr<const ColourClass>> Extractor::Workspace::classesFor(const CellGrid& grid) const {
  std::vector<std::shared_ptr<const ColourClass>> made;
  if (grid.layout == CellLayout::kBytes) return made;
  for (const ColourRange& colour : colours)
    made.push_back(
        ColourClass::of(colour, grid.red_first ? ColourClass::Order::kRgb : ColourClass::Order::kBgr));
  return made;
}

void Extractor::Workspace::resize(const ImageView& image) {
  if (image.width == width && image.height == height && image.format == format) return;
  const CellGrid grid(image);
  width = image.width;
  height = image.height;
  format = image.format;
  finder.setSides(sideInCells(options.opening_px, grid), sideInCells(options.closing_px, grid));
  finder.resize(grid.width, grid.height);
  search = SearchWindows(finder.border());
  if (!ignored_areas.empty()) fillMask(ignored_areas, grid, ignored);
  classes = classesFor(grid);  // those that `prepare` has built, if it did
}

CellRule Extractor::Workspace::ruleOf(std::size_t colour) const {
  return {classes.empty() ? nullptr : classes[colour].get(),
          static_cast<std::uint8_t>(colours[colour].value_low),
          static_cast<std::uint8_t>(colours[colour].value_high),
          static_cast<std::uint8_t>(options.background_threshold)};
}

void Extractor::Workspace::findMarkers(const ImageView& image, Observation& observation) {
  const CellGrid grid(image);
  bool done = false;
  if (++since_whole < options.whole_every && search.place(predictions, observation.exposure, grid)) {
    findRegions(grid, search.windows());
    done = search.hold(selection.sorted());
  }
  if (!done) {
    findRegions(grid, {});
    since_whole = 0;
  }
  observation.truncated = selection.truncated();
  for (const ColouredRegion& region : selection.sorted()) locate(region, grid, observation);
}

void Extractor::Workspace::findRegions(const CellGrid& grid, std::span<const WordRect> windows) {
  BackgroundCells empty;
  const bool has_background = background.state() == BackgroundModel::State::kReady;
  if (has_background) empty = BackgroundCells(CellGrid(background.view()), &background.ranges());
  selection.clear();
  for (std::size_t i = 0; i < colours.size(); ++i)
    selection.add(finder.find(grid, has_background ? &empty : nullptr, ruleOf(i),
                              ignored_areas.empty() ? nullptr : &ignored, nullptr, windows),
                  static_cast<int>(i), grid);
}

void Extractor::Workspace::adaptBackground(const ImageView& image) {
  if (options.background_rows == 0) return;
  BackgroundModel::KeptOut kept_out;
  if (const auto found = selection.sorted(); !found.empty()) {
    kept_out = {width, height, -1, -1};
    for (const auto& [region, colour] : found)
      kept_out = {std::min(kept_out.left, region.left), std::min(kept_out.top, region.top),
                  std::max(kept_out.right, region.right), std::max(kept_out.bottom, region.bottom)};
    const auto size = static_cast<int>(cellSize(CellGrid(image)));
    const int around =
        kAround + size * std::max(kept_out.right - kept_out.left, kept_out.bottom - kept_out.top) / 2;
    kept_out = {size * kept_out.left - around, size * kept_out.top - around,
                size * (kept_out.right + 1) + around, size * (kept_out.bottom + 1) + around};
  }
  background.adapt(image, options.background_rows, options.background_threshold, kept_out);
}

void Extractor::Workspace::locate(const ColouredRegion& region, const CellGrid& grid,
                                  Observation& observation) {
  if (options.estimator == CentroidEstimator::kDisc) {
    if (const auto pair = disc_fit.fitTwo(grid, region.region)) {
      for (const Disc& disc : *pair) add(discCentroid(region, disc, grid), observation);
      return;
    }
    if (const auto disc = disc_fit.fit(grid, region.region))
      return add(discCentroid(region, *disc, grid), observation);
    Centroid centroid = binaryCentroid(region, grid, options.centroid_sigma_px);
    centroid.covariance += cellSize(grid) * cellSize(grid) * disc_fit.smear();
    return add(centroid, observation);
  }
  add(binaryCentroid(region, grid, options.centroid_sigma_px), observation);
}

void Extractor::Workspace::add(const Centroid& centroid, Observation& observation) {
  if (observation.count == kMaxCentroids)
    observation.truncated = true;
  else
    observation.centroids[static_cast<std::size_t>(observation.count++)] = centroid;
}

Extractor::Extractor(const MarkerOptions& options) {
  validate(options);
  workspace_ = std::make_unique<Workspace>(options);
}

Extractor::~Extractor() = default;
Extractor::Extractor(Extractor&&) noexcept = default;
Extractor& Extractor::operator=(Extractor&&) noexcept = default;

void Extractor::prepare(PixelFormat format) {
  ImageView image;
  image.format = format;
  workspace_->classes = workspace_->classesFor(CellGrid(image));
}

void Extractor::takeBackground() {
  workspace_->background.take();
}
void Extractor::setBackground(const ImageView& image) {
  workspace_->background.set(image);
}
void Extractor::disableBackground() {
  workspace_->background.disable();
}
bool Extractor::hasBackground() const {
  return workspace_->background.state() == BackgroundModel::State::kReady;
}
ImageView Extractor::background() const {
  return workspace_->background.view();
}

void Extractor::setIgnoredAreas(const IgnoredAreas& areas) {
  workspace_->ignored_areas = areas;
  workspace_->format.reset();
}
void Extractor::setColours(const MarkerColours& colours) {
  workspace_->colours = colours.ranges;
  workspace_->format.reset();
}

void Extractor::expect(const BallPredictions& predictions) {
  workspace_->predictions = predictions;
}
bool Extractor::readWhole() const {
  return workspace_->since_whole == 0;
}

void Extractor::extract(const ImageView& image, Observation& observation) {
  Workspace& work = *workspace_;
  work.resize(image);
  work.background.update(image);
  observation.count = 0;
  observation.truncated = false;
  if (work.background.state() != BackgroundModel::State::kTaking) {
    work.findMarkers(image, observation);
    work.adaptBackground(image);
  }
}

}  // namespace helical
