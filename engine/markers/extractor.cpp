#include "engine/markers/extractor.h"

#include <algorithm>
#include <cstdlib>

#include "engine/base/clock.h"
#include "engine/markers/background_model.h"
#include "engine/markers/binary_mask.h"
#include "engine/markers/colour_class.h"
#include "engine/markers/region_labeller.h"

namespace helical {
namespace {

bool differs(const std::uint8_t* a, const std::uint8_t* b, int channels, int threshold) {
  for (int i = 0; i < channels; ++i)
    if (std::abs(a[i] - b[i]) > threshold) return true;
  return false;
}

}  // namespace

struct Extractor::Workspace {
  explicit Workspace(const MarkerOptions& marker_options)
      : options(marker_options),
        colour(ColourClass::of(marker_options)),
        background(marker_options.background_frames) {}

  void resize(const ImageView& image);
  void classify(const ImageView& image);
  std::uint64_t classifyColour(const std::uint8_t* pixels, const std::uint8_t* empty, int count) const;
  std::uint64_t classifyGrey(const std::uint8_t* pixels, const std::uint8_t* empty, int count) const;
  const BinaryMask& openAndClose();

  MarkerOptions options;
  std::shared_ptr<const ColourClass> colour;
  BackgroundModel background;
  BinaryMask first;
  BinaryMask second;
  RegionLabeller labeller;
};

void Extractor::Workspace::resize(const ImageView& image) {
  if (image.width == first.width() && image.height == first.height()) return;
  first.resize(image.width, image.height);
  second.resize(image.width, image.height);
  labeller.resize(image.width, image.height);
}

void Extractor::Workspace::classify(const ImageView& image) {
  const bool in_colour = image.format == PixelFormat::kBgr8;
  const int channels = in_colour ? 3 : 1;
  const bool has_background = background.state() == BackgroundModel::State::kReady;
  const ImageView empty = background.view();
  int top = image.height, bottom = -1;
  for (int y = 0; y < image.height; ++y) {
    std::uint64_t* words = first.row(y);
    std::uint64_t any = 0;
    for (int x = 0; x < image.width; x += 64) {
      const std::uint8_t* pixels = image.row(y) + x * channels;
      const std::uint8_t* behind = has_background ? empty.row(y) + x * channels : nullptr;
      const int count = std::min(64, image.width - x);
      words[x / 64] = in_colour ? classifyColour(pixels, behind, count) : classifyGrey(pixels, behind, count);
      any |= words[x / 64];
    }
    if (any == 0) continue;
    top = std::min(top, y);
    bottom = y;
  }
  first.setBand(top, bottom);
}

std::uint64_t Extractor::Workspace::classifyColour(const std::uint8_t* pixels, const std::uint8_t* empty,
                                                   int count) const {
  if (count == 64 && !colour->mayContain64(pixels)) return 0;
  std::uint64_t bits = 0;
  for (int i = 0; i < count; ++i) {
    if (!colour->contains(pixels + 3 * i)) continue;
    if (empty != nullptr && !differs(pixels + 3 * i, empty + 3 * i, 3, options.background_threshold))
      continue;
    bits |= std::uint64_t{1} << i;
  }
  return bits;
}

std::uint64_t Extractor::Workspace::classifyGrey(const std::uint8_t* pixels, const std::uint8_t* empty,
                                                 int count) const {
  std::uint64_t bits = 0;
  for (int i = 0; i < count; ++i) {
    if (pixels[i] < options.value_low || pixels[i] > options.value_high) continue;
    if (empty != nullptr && !differs(pixels + i, empty + i, 1, options.background_threshold)) continue;
    bits |= std::uint64_t{1} << i;
  }
  return bits;
}

const BinaryMask& Extractor::Workspace::openAndClose() {
  if (first.lastRow() < first.firstRow()) return first;
  if (const int reach = options.opening_px / 2; reach > 0) {
    second.erode(first, reach);
    first.dilate(second, reach);
  }
  if (const int reach = options.closing_px / 2; reach > 0) {
    second.dilate(first, reach);
    first.erode(second, reach);
  }
  return first;
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

void Extractor::extract(const ImageView& image, Observation& observation) {
  const TimeNs start = threadCpuTime();
  Workspace& work = *workspace_;
  work.resize(image);
  work.background.update(image);
  observation.count = 0;
  observation.truncated = false;
  if (work.background.state() != BackgroundModel::State::kTaking) {
    work.classify(image);
    fillCentroids(work.labeller.label(work.openAndClose()), work.options, observation);
  }
  observation.extraction = threadCpuTime() - start;
}

}  // namespace helical
