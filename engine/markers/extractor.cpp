#include "engine/markers/extractor.h"

#include <memory>
#include <optional>
#include <vector>

#include "engine/base/clock.h"
#include "engine/markers/background_model.h"
#include "engine/markers/disc_fit.h"
#include "engine/markers/region_finder.h"
#include "engine/markers/region_selection.h"

namespace helical {
namespace {

/// px per axis: what the pixels' noise does not explain, such as the edge's sampling.
constexpr double kDiscSigma = 0.01;

}  // namespace

struct Extractor::Workspace {
  explicit Workspace(const MarkerOptions& marker_options)
      : options(marker_options),
        background(marker_options.background_frames),
        finder(marker_options.opening_px, marker_options.closing_px),
        selection(options) {
    colours.push_back(options);
    colours.insert(colours.end(), options.other_colours.begin(), options.other_colours.end());
  }

  void resize(const ImageView& image);
  CellRule ruleOf(std::size_t colour) const;
  void findMarkers(const ImageView& image, Observation& observation);
  Centroid locate(const ColouredRegion& region, const CellGrid& grid);

  MarkerOptions options;
  std::vector<ColourRange> colours;
  std::vector<std::shared_ptr<const ColourClass>> classes;  ///< of `colours`, for `format`
  BackgroundModel background;
  RegionFinder finder;
  RegionSelection selection;
  DiscFit disc_fit;
  int width = 0;
  int height = 0;
  std::optional<PixelFormat> format;
};

void Extractor::Workspace::resize(const ImageView& image) {
  if (image.width == width && image.height == height && image.format == format) return;
  const CellGrid grid(image);
  width = image.width;
  height = image.height;
  format = image.format;
  finder.resize(grid.width, grid.height);
  std::vector<std::shared_ptr<const ColourClass>> prepared;
  if (grid.layout != CellLayout::kBytes)
    for (const ColourRange& colour : colours)
      prepared.push_back(
          ColourClass::of(colour, grid.red_first ? ColourClass::Order::kRgb : ColourClass::Order::kBgr));
  classes = std::move(prepared);  // not before: extractors that share tables keep them while one changes
}

CellRule Extractor::Workspace::ruleOf(std::size_t colour) const {
  return {classes.empty() ? nullptr : classes[colour].get(),
          static_cast<std::uint8_t>(colours[colour].value_low),
          static_cast<std::uint8_t>(colours[colour].value_high),
          static_cast<std::uint8_t>(options.background_threshold)};
}

void Extractor::Workspace::findMarkers(const ImageView& image, Observation& observation) {
  const CellGrid grid(image);
  CellGrid empty;
  const bool has_background = background.state() == BackgroundModel::State::kReady;
  if (has_background) empty = CellGrid(background.view());
  selection.clear();
  for (std::size_t i = 0; i < colours.size(); ++i)
    selection.add(finder.find(grid, has_background ? &empty : nullptr, ruleOf(i)), static_cast<int>(i), grid);
  for (const ColouredRegion& region : selection.sorted())
    observation.centroids[static_cast<std::size_t>(observation.count++)] = locate(region, grid);
  observation.truncated = selection.truncated();
}

Centroid Extractor::Workspace::locate(const ColouredRegion& region, const CellGrid& grid) {
  if (options.estimator == CentroidEstimator::kDisc)
    if (const auto disc = disc_fit.fit(grid, region.region))
      return discCentroid(region, *disc, grid, kDiscSigma);
  return binaryCentroid(region, grid, options.centroid_sigma_px);
}

Extractor::Extractor(const MarkerOptions& options) {
  validate(options);
  workspace_ = std::make_unique<Workspace>(options);
}

Extractor::~Extractor() = default;
Extractor::Extractor(Extractor&&) noexcept = default;
Extractor& Extractor::operator=(Extractor&&) noexcept = default;

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

void Extractor::setColour(const ColourRange& colour) {
  static_cast<ColourRange&>(workspace_->options) = colour;
  workspace_->colours.front() = colour;
  workspace_->format.reset();  // the next frame prepares anew
}

void Extractor::extract(const ImageView& image, Observation& observation) {
  const TimeNs start = threadCpuTime();
  Workspace& work = *workspace_;
  work.resize(image);
  work.background.update(image);
  observation.count = 0;
  observation.truncated = false;
  if (work.background.state() != BackgroundModel::State::kTaking) work.findMarkers(image, observation);
  observation.extraction = threadCpuTime() - start;
}

}  // namespace helical
