#include "engine/markers/disc_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/markers/disc_normal.h"

namespace helical {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kMargin = 3;             ///< cells around the region's box
constexpr double kReach = 2.5;         ///< cells outside of the region's box that are fitted, too
constexpr double kLeastChroma = 12.0;  ///< levels: below, a ball is told by its brightness
constexpr float kLeastScale = 0.7F;    ///< levels: quantisation and what the model leaves out
/// Squared levels: no fit is believed to scatter by less than half of that.
constexpr double kLeastVariance = 0.25 * kLeastScale * kLeastScale;
constexpr double kLeastContrast = 8.0;
constexpr int kSteps = 6;
constexpr int kRounds = 3;
/// Share of the contrast that residuals may have beyond noise: a ball with a pattern or smeared by its motion
/// is no shaded disc, and its centre of gravity is the steadier estimate.
constexpr double kWorstMisfit = 0.12;
/// Cells. Of a ball so large the region's centre of gravity is good, and what the model lacks (prints, hands,
/// blur: measured on a real ball of 28 pixels) does more harm than noise: the disc must be close to the
/// region.
constexpr double kLarge = 12.0;
constexpr double kLargeSeen = 0.97;
constexpr double kLargeApart = 0.065;  ///< of the radius
constexpr double kLongTail = 1.8;  ///< mean square over that of a normal distribution: something does not fit
constexpr double kSettled = 3e-3;  ///< cells: a smaller step is the last
constexpr double kOutlineSigma = 0.15;  ///< cells, per axis: of a circle through an outline
constexpr int kRays = 24;
/// Of a disc with an edge before it: the same with room for the few cells that the noise is known by, and
/// the share that must be seen. What is no such disc leaves ten times as much.
constexpr double kCutTail = 3.0, kLeastSeen = 0.3;
/// Elongation: from the first on, what looks like a disc may have moved; from the second on, what is no disc
/// may be smeared; from the third on, it is not asked whether it is a disc, which noise makes longish by no
/// more.
constexpr double kMaybeSmeared = 1.06, kLeastSmear = 1.07, kSurelySmeared = 1.25;
constexpr double kMaybeMoved = 4.5;  ///< chi-square of what a motion leaves on both sides of the outline
constexpr double kRim = 1.5;         ///< cells, on either side
constexpr double kSurelyLong = 2.8;  ///< elongation: nothing hides so much of a ball that is still found
constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr double kRatherCut = 8.0;    ///< chi-square: what is as well hidden as moving is taken for hidden
constexpr double kSurelyOne = 1.4;    ///< misfit of a smeared ball that is no pair
constexpr double kSurelyMoved = 9.0;  ///< chi-square over a ball at rest
/// Cells of a region: fewer say too little of which of its sides are alike.
constexpr std::int64_t kFewestSmeared = 40;

/// The unknowns: those of the model, and of a second channel the ball's level over that of the first, and the
/// level around it.
constexpr int kRatio = kDiscParameters, kSecondAround = kRatio + 1, kUnknowns = kSecondAround + 1;
constexpr double kUneven = 3.0;       ///< scatter of the brightness over that of the colour that is too much
constexpr float kOutside = 3.5F;      ///< scales: what lies farther off is no noise
constexpr double kSeenOutline = 0.5;  ///< share of the outline that the brightness must show
constexpr double kDisagreement = 16.0;  ///< chi-square between colour and both

using Normal = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using ModelVector = Eigen::Matrix<double, kDiscParameters, 1>;

const Eigen::Vector3d kGrey = Eigen::Vector3d::Constant(0.5773502691896258);

/// Directions of the rays: the corners of a polygon, by Pythagorean half angles, without trigonometry.
constexpr auto kDirections = [] {
  std::array<std::array<double, 2>, kRays> directions{};
  constexpr std::array<double, 6> kCos{1.0, 0.9659258262890683, 0.8660254037844387, 0.7071067811865476,
                                       0.5, 0.25881904510252074};
  for (std::size_t i = 0; i < kRays; ++i) {
    double x = kCos[i % 6], y = i % 6 == 0 ? 0.0 : kCos[6 - i % 6];
    for (std::size_t quarter = 0; quarter < i / 6; ++quarter) {
      const double turned = -y;
      y = x;
      x = turned;
    }
    directions[i] = {x, y};
  }
  return directions;
}();

Disc discOf(const SmearedBall& ball) {
  Disc disc;
  disc.centre = ball.centre;
  disc.half_way = ball.half;
  disc.covariance = ball.covariance;
  disc.radius = ball.radius;
  disc.seen_share = std::clamp(ball.seen / (kPi * disc.radius * disc.radius), 0.0, 1.0);
  return disc;
}

/// Sorts some of them.
float median(std::span<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

/// The normal equations at the current parameters.
struct DiscFit::System {
  Normal normal = Normal::Zero();
  Vector gradient = Vector::Zero();
  double count = 0.0;  ///< of the values
  double squares = 0.0;
};

DiscFit::DiscFit() : colour_(std::make_unique<DiscCells>()), brightness_(std::make_unique<DiscCells>()) {}

std::optional<Disc> DiscFit::fit(const CellGrid& grid, const Region& region) {
  smear_.setZero();
  return readWindow(grid, region) ? fitWindow(grid) : std::nullopt;
}

std::optional<Disc> DiscFit::fitWindow(const CellGrid& grid) {
  const auto by_colour = fitColour(grid);
  if (!by_colour || !has_colour_ || !by_colour->half_way.isZero()) return by_colour;
  return withBrightness(*by_colour);
}

std::optional<std::array<Disc, 2>> DiscFit::fitTwo(const CellGrid& grid, const Region& region) {
  if (!OverlapSplit::mayBeTwo(region) || !readWindow(grid, region)) return std::nullopt;
  const ValueWindow values = window(region);
  auto pair = split_.circles(values);
  if (!pair || isOneMoving(grid)) return std::nullopt;
  std::array<Region, 2> parts{OverlapSplit::partOf(values, (*pair)[0], (*pair)[1]),
                              OverlapSplit::partOf(values, (*pair)[1], (*pair)[0])};
  for (std::size_t i = 0; i < 2; ++i) {
    Region& part = parts[i];
    part.sum_x += part.area * left_;
    part.sum_y += part.area * top_;
    part.left += left_, part.right += left_, part.top += top_, part.bottom += top_;
    (*pair)[i].centre.x += left_;
    (*pair)[i].centre.y += top_;
  }
  return std::array<Disc, 2>{fitPart(grid, parts[0], (*pair)[0], (*pair)[1]),
                             fitPart(grid, parts[1], (*pair)[1], (*pair)[0])};
}

bool DiscFit::isOneMoving(const CellGrid& grid) {
  const auto ball = fitMoving(grid, smearOfRegion(), nullptr, kAny);
  return ball && ball->misfit < kSurelyOne;
}

Disc DiscFit::fitPart(const CellGrid& grid, Region part, const OutlineCircle& mine,
                      const OutlineCircle& other) {
  neighbour_ = other;
  std::optional<Disc> disc;
  if (readWindow(grid, part)) {
    binary_ = {{mine.centre.x - left_, mine.centre.y - top_}, mine.radius};
    disc = fitWindow(grid);
  }
  neighbour_.reset();
  if (disc) return *disc;
  Disc outline;
  outline.centre = {mine.centre.x, mine.centre.y};
  outline.covariance = kOutlineSigma * kOutlineSigma * Eigen::Matrix2d::Identity();
  outline.radius = mine.radius;
  outline.seen_share = std::min(1.0, static_cast<double>(part.area) / (kPi * mine.radius * mine.radius));
  return outline;
}

ValueWindow DiscFit::window(const Region& region) {
  std::size_t count = 0;
  const auto size = static_cast<std::size_t>(width_ * height_), area = static_cast<std::size_t>(region.area);
  std::copy_n(values_.begin(), size, sorted_.begin());
  const auto middle =
      sorted_.begin() + static_cast<std::ptrdiff_t>(size - std::max<std::size_t>(1, area / 2));
  std::nth_element(sorted_.begin(), middle, sorted_.begin() + static_cast<std::ptrdiff_t>(size));
  const float ball = *middle;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (x == 0 || y == 0 || x == width_ - 1 || y == height_ - 1)
        sorted_[count++] = values_[static_cast<std::size_t>(y * width_ + x)];
  const float around = median(std::span(sorted_.data(), count));
  return {values_.data(), width_, height_, 0.5F * (ball + around), 0.5F * (ball - around)};
}

Smear DiscFit::smearOfRegion() {
  if (neighbour_) return {};
  const ValueWindow values = window(region_);
  return measureSmear({{colour_->x.data(), real_count_},
                       {colour_->y.data(), real_count_},
                       {colour_->value.data(), real_count_},
                       static_cast<double>(values.level),
                       static_cast<double>(values.contrast)});
}

std::optional<SmearedBall> DiscFit::fitMoving(const CellGrid& grid, const Smear& smear,
                                              const Parameters* at_rest, double most_excess) {
  if (!(smear.shorter > 0.0)) return std::nullopt;
  const ValueWindow values = window(region_);
  SmearStart start;
  start.middle = smear.middle + Eigen::Vector2d(left_, top_);
  start.half = std::sqrt(3.0 * (smear.longer - smear.shorter)) * smear.axis;
  start.radius = 2.0 * std::sqrt(smear.shorter);
  start.ball = static_cast<double>(values.level + values.contrast);
  start.around = static_cast<double>(values.level - values.contrast);
  std::array<float, kDiscParameters> disc{};
  if (at_rest != nullptr) {
    disc = *at_rest;
    disc[kDiscX] += static_cast<float>(left_);
    disc[kDiscY] += static_cast<float>(top_);
  }
  const auto ball = smear_fit_.fit(grid, axis_, start, at_rest != nullptr ? &disc : nullptr, most_excess);
  const bool is_ball = ball && ball->contrast > kLeastContrast && ball->misfit < kCutTail &&
                       ball->gain > kSurelyMoved && !isDoubtful(*ball, start, smear);
  return is_ball ? ball : std::nullopt;
}

float DiscFit::givenAt(double x, double y) const {
  if (!neighbour_) return 1.0F;
  const double dx = left_ + x - neighbour_->centre.x, dy = top_ + y - neighbour_->centre.y,
               reach = neighbour_->radius + 1.0;
  return dx * dx + dy * dy < reach * reach ? 0.0F : 1.0F;
}

std::optional<Disc> DiscFit::fitColour(const CellGrid& grid) {
  const Smear smear = smearOfRegion();
  const bool has_sides = region_.area >= kFewestSmeared;
  if (has_sides && smear.elongation > kLeastSmear) smear_ = smear.covariance;
  const bool is_smeared = has_sides && smear.isOver(kSurelySmeared);
  start(binary_);
  std::array<OutlinePoint, kRays> room;
  const std::span outline(room.data(), static_cast<std::size_t>(traceOutline(room)));
  if (!is_smeared && descend(kSteps) && isPlausible() && fitsEverywhere()) {
    if (!neighbour_ && mayHaveMoved(smear))
      if (const auto ball = fitMoving(grid, smear, &p_, kAny)) return discOf(*ball);
    if (const auto disc = result()) return disc;
  }
  if (!neighbour_)
    if (const auto disc = fitMovingOrCut(grid, smear)) return disc;
  if (has_sides && smear.isOver(kLeastSmear)) return std::nullopt;
  start(neighbour_ ? binary_ : bestCircle(outline, binary_.radius).value_or(binary_));
  for (int round = 0; round < kRounds; ++round) {
    leaveOutHidden();
    if (!descend(kSteps) || !isPlausible()) return std::nullopt;
  }
  return result();
}

bool DiscFit::mayHaveMoved(const Smear& smear) {
  return smear.elongation > kMaybeSmeared || motionInResiduals() > kMaybeMoved;
}

double DiscFit::motionInResiduals() {
  const DiscCells& cells = *colour_;
  const double x = p_[kDiscX], y = p_[kDiscY], radius = p_[kDiscRadius], noise = noiseAround();
  const double least = std::max(0.0, radius - kRim), most = radius + kRim;
  double by_cosine = 0.0, by_sine = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < real_count_; ++i) {
    const double dx = cells.x[i] - x, dy = cells.y[i] - y, d2 = dx * dx + dy * dy;
    if (d2 <= least * least || d2 >= most * most) continue;
    const double beyond = std::sqrt(d2) - radius,
                 value = beyond * static_cast<double>(cells.residual[i]) / d2;
    by_cosine += value * (dx * dx - dy * dy);
    by_sine += value * 2.0 * dx * dy;
    weights += beyond * beyond;
  }
  return (by_cosine * by_cosine + by_sine * by_sine) / (0.5 * noise * noise * std::max(1e-9, weights));
}

std::optional<Disc> DiscFit::fitMovingOrCut(const CellGrid& grid, const Smear& smear) {
  const bool is_smeared = region_.area >= kFewestSmeared && smear.isOver(kLeastSmear);
  // Of a large ball only one that is seen nearly whole is believed, which no edge hides a part of.
  std::optional<Disc> cut;
  double excess = kAny;
  if (binary_.radius < kLarge && !is_smeared && smear.elongation < kSurelyLong) cut = fitCut(excess);
  const auto ball = fitMoving(grid, smear, nullptr, cut ? excess - kRatherCut : kAny);
  return ball && (!cut || ball->excess < excess - kRatherCut) ? discOf(*ball) : cut;
}

std::optional<Disc> DiscFit::fitCut(double& excess) {
  DiscCells& cells = *colour_;
  start(binary_);
  const CutDisc cut = nearestCut(p_, cells);
  p_ = cut.disc;
  double seen = 0.0;
  for (std::size_t i = 0; i < real_count_; ++i) seen += cells.cover[i];
  const auto disc = believed(cut.covariance(cells, kLeastVariance), seen);
  const double noise = noiseAround(), squares = cut.squares / (noise * noise);
  excess = squares - cut.count;
  if (squares > kCutTail * cut.count || !isPlausible() || !disc || disc->seen_share < kLeastSeen)
    return std::nullopt;
  leaveOutHidden();
  return disc;
}

std::optional<Disc> DiscFit::withBrightness(const Disc& by_colour) {
  if (!startBrightness() || !descend(kSteps) || !isPlausible()) return by_colour;
  const auto by_both = result();
  if (!by_both) return by_colour;
  const Eigen::Vector2d apart = by_both->centre - by_colour.centre;
  return apart.squaredNorm() < kDisagreement * by_colour.covariance.trace() ? *by_both : by_colour;
}

bool DiscFit::readWindow(const CellGrid& grid, const Region& region) {
  left_ = std::max(0, region.left - kMargin);
  top_ = std::max(0, region.top - kMargin);
  width_ = std::min(grid.width - 1, region.right + kMargin) - left_ + 1;
  height_ = std::min(grid.height - 1, region.bottom + kMargin) - top_ + 1;
  if (width_ < 2 || height_ < 2 || width_ > kLargestSide || height_ > kLargestSide) return false;
  region_ = region;
  const auto area = static_cast<double>(region.area);
  binary_ = {
      {static_cast<double>(region.sum_x) / area - left_, static_cast<double>(region.sum_y) / area - top_},
      std::sqrt(area / kPi) + 0.3};
  axis_ = grid.layout == CellLayout::kBytes ? Eigen::Vector3d::UnitX() : colourAxis(grid, region);
  has_colour_ = grid.layout != CellLayout::kBytes && axis_ != kGrey;
  const double middle_x = 0.5 * (region.left + region.right) - left_;
  const double middle_y = 0.5 * (region.top + region.bottom) - top_;
  const double reach = 0.5 * std::max(region.right - region.left, region.bottom - region.top) + 0.5 + kReach;
  std::array<std::uint8_t, 3> cell{};
  DiscCells& cells = *colour_;
  cells.count = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      readCell(grid, left_ + x, top_ + y, cell.data());
      const auto value = static_cast<float>(axis_[0] * cell[0] + axis_[1] * cell[1] + axis_[2] * cell[2]);
      values_[static_cast<std::size_t>(y * width_ + x)] = value;
      const double dx = x - middle_x, dy = y - middle_y;
      if (dx * dx + dy * dy > reach * reach) continue;
      const std::size_t i = cells.count++;
      cells.x[i] = static_cast<float>(x);
      cells.y[i] = static_cast<float>(y);
      cells.value[i] = value;
      cells.given[i] = givenAt(x, y);
      brightness_->value[i] = static_cast<float>(kGrey[0] * (cell[0] + cell[1] + cell[2]));
    }
  real_count_ = cells.count;
  is_marked_.fill(0);
  for (; cells.count % kDiscLanes != 0; ++cells.count) {
    cells.x[cells.count] = cells.y[cells.count] = cells.value[cells.count] = 0.0F;
    cells.given[cells.count] = brightness_->value[cells.count] = 0.0F;
  }
  brightness_weight_ = 0.0;
  return true;
}

Eigen::Vector3d DiscFit::colourAxis(const CellGrid& grid, const Region& region) const {
  // The middle of the region: cells that are the ball's alone.
  const auto x = static_cast<int>(region.sum_x / region.area),
             y = static_cast<int>(region.sum_y / region.area);
  const int reach = std::min(region.right - region.left, region.bottom - region.top) / 4;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::array<std::uint8_t, 3> cell{};
  int count = 0;
  for (int j = std::max(0, y - reach); j <= std::min(grid.height - 1, y + reach); ++j)
    for (int i = std::max(0, x - reach); i <= std::min(grid.width - 1, x + reach); ++i, ++count) {
      readCell(grid, i, j, cell.data());
      sum += Eigen::Vector3d(cell[0], cell[1], cell[2]);
    }
  const Eigen::Vector3d mean = sum / count, chroma = mean - Eigen::Vector3d::Constant(mean.sum() / 3.0);
  if (chroma.squaredNorm() >= kLeastChroma * kLeastChroma) return chroma / std::sqrt(chroma.squaredNorm());
  return kGrey;
}

double DiscFit::valueAt(double x, double y) const {
  const int i = std::clamp(static_cast<int>(x), 0, width_ - 2),
            j = std::clamp(static_cast<int>(y), 0, height_ - 2);
  const double a = std::clamp(x - i, 0.0, 1.0), b = std::clamp(y - j, 0.0, 1.0);
  const float* v = values_.data() + j * width_ + i;
  return (1.0 - b) * ((1.0 - a) * v[0] + a * v[1]) + b * ((1.0 - a) * v[width_] + a * v[width_ + 1]);
}

void DiscFit::start(const OutlineCircle& circle) {
  const DiscCells& cells = *colour_;
  double inside = 0.0, outside = 0.0;
  int inside_count = 0, outside_count = 0;
  for (std::size_t i = 0; i < cells.count; ++i) {
    if (cells.given[i] == 0.0F) continue;
    const double dx = cells.x[i] - circle.centre.x, dy = cells.y[i] - circle.centre.y, d2 = dx * dx + dy * dy;
    if (d2 < 0.4 * circle.radius * circle.radius) inside += cells.value[i], ++inside_count;
    if (d2 > (circle.radius + 1.0) * (circle.radius + 1.0)) outside += cells.value[i], ++outside_count;
  }
  p_.fill(0.0F);
  p_[kDiscX] = static_cast<float>(circle.centre.x);
  p_[kDiscY] = static_cast<float>(circle.centre.y);
  p_[kDiscRadius] = static_cast<float>(circle.radius);
  p_[kDiscAmbient] = static_cast<float>(inside / std::max(1, inside_count));
  p_[kDiscAround] = static_cast<float>(outside / std::max(1, outside_count));
}

float DiscFit::residualScale(const DiscCells& cells) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < cells.count; ++i)
    if (cells.given[i] != 0.0F) sorted_[count++] = std::abs(cells.residual[i]);
  return std::max(kLeastScale, 1.4826F * median(std::span(sorted_.data(), count)));
}

bool DiscFit::fitsEverywhere() {
  const System system = linearise();
  // Where the whole ball fits badly, the scatter of all cells would excuse it; around it there is noise
  // alone.
  const double scale = noiseAround();
  return system.squares < kLongTail * scale * scale * system.count;
}

float DiscFit::noiseAround() {
  std::size_t count = 0;
  for (std::size_t i = 0; i < real_count_; ++i)
    if (colour_->given[i] != 0.0F && colour_->cover[i] == 0.0F)
      sorted_[count++] = std::abs(colour_->residual[i]);
  return count > 0 ? std::max(kLeastScale, 1.4826F * median(std::span(sorted_.data(), count))) : kLeastScale;
}

std::size_t DiscFit::placeOf(std::size_t cell) const {
  return static_cast<std::size_t>(colour_->y[cell]) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(colour_->x[cell]);
}

void DiscFit::leaveOutHidden() {
  DiscCells& cells = *colour_;
  evaluateDisc(p_, hasShadow(p_), cells);
  is_marked_.fill(0);
  const float around = p_[kDiscAround];
  for (std::size_t i = 0; i < real_count_; ++i) {
    const float expected = cells.value[i] - cells.residual[i] - around;
    cells.given[i] = givenAt(cells.x[i], cells.y[i]);
    if (cells.cover[i] > 0.5F && cells.value[i] - around < 0.5F * expected) is_marked_[placeOf(i)] = 1;
  }
  leaveOutMarked(cells);
}

void DiscFit::leaveOutMarked(DiscCells& cells) {
  for (std::size_t i = 0; i < real_count_; ++i) {
    const auto x = static_cast<int>(colour_->x[i]), y = static_cast<int>(colour_->y[i]);
    // The neighbours of a hidden cell are partly hidden.
    for (int ny = std::max(0, y - 1); ny <= std::min(height_ - 1, y + 1); ++ny)
      for (int nx = std::max(0, x - 1); nx <= std::min(width_ - 1, x + 1); ++nx)
        if (is_marked_[static_cast<std::size_t>(ny * width_ + nx)] != 0) cells.given[i] = 0.0F;
  }
}

bool DiscFit::startBrightness() {
  DiscCells &colour = *colour_, &brightness = *brightness_;
  brightness.count = colour.count;
  std::copy_n(colour.x.begin(), colour.count, brightness.x.begin());
  std::copy_n(colour.y.begin(), colour.count, brightness.y.begin());
  std::copy_n(colour.given.begin(), colour.count, brightness.given.begin());
  evaluateDisc(p_, hasShadow(p_), colour);
  const float colour_scale = residualScale(colour);
  levelBrightness();
  evaluateDisc(brightnessParameters(), hasShadow(p_), brightness);
  leaveOutUneven(kOutside * residualScale(brightness));
  const float scale = residualScale(brightness);
  if (scale > kUneven * colour_scale) return false;
  brightness_weight_ =
      static_cast<double>(colour_scale) * colour_scale / (static_cast<double>(scale) * scale);
  double outline = 0.0, seen = 0.0;
  for (std::size_t i = 0; i < real_count_; ++i) {
    if (colour.given[i] == 0.0F || colour.cover[i] < 0.05F || colour.cover[i] > 0.95F) continue;
    outline += 1.0;
    seen += brightness.given[i];
  }
  return seen > kSeenOutline * outline;
}

void DiscFit::levelBrightness() {
  const DiscCells &colour = *colour_, &brightness = *brightness_;
  const auto medianOver = [&](auto isWanted, auto valueOf) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < real_count_; ++i)
      if (colour.given[i] != 0.0F && isWanted(colour.cover[i])) sorted_[count++] = valueOf(i);
    return count > 0 ? median(std::span(sorted_.data(), count)) : 0.0F;
  };
  brightness_around_ = medianOver([](float cover) { return cover == 0.0F; },
                                  [&](std::size_t i) { return brightness.value[i]; });
  brightness_over_colour_ =
      medianOver([](float cover) { return cover == 1.0F; },
                 [&](std::size_t i) { return brightness.value[i] / (colour.value[i] - colour.residual[i]); });
}

void DiscFit::leaveOutUneven(float limit) {
  DiscCells& cells = *brightness_;
  // What is hidden stays marked in the colour's cells only.
  const auto hidden = is_marked_;
  is_marked_.fill(0);
  for (std::size_t i = 0; i < real_count_; ++i)
    if (std::abs(cells.residual[i]) > limit) is_marked_[placeOf(i)] = 1;
  leaveOutMarked(cells);
  is_marked_ = hidden;
}

DiscFit::Parameters DiscFit::brightnessParameters() const {
  Parameters p = p_;
  for (const DiscParameter k : {kDiscAmbient, kDiscLightX, kDiscLightY, kDiscLightZ})
    p[k] *= brightness_over_colour_;
  p[kDiscAround] = brightness_around_;
  return p;
}

DiscFit::System DiscFit::linearise() {
  System system;
  DiscSums sums;
  evaluateDisc(p_, hasShadow(p_), *colour_);
  sumDisc(*colour_, sums);
  system.normal.topLeftCorner<kDiscParameters, kDiscParameters>() = normalOf<kDiscParameters>(sums);
  system.gradient.head<kDiscParameters>() = Eigen::Map<const ModelVector>(sums.gradient.data());
  system.count = sums.count;
  system.squares = sums.squares;
  if (brightness_weight_ > 0.0) {
    evaluateDisc(brightnessParameters(), hasShadow(p_), *brightness_);
    sumDisc(*brightness_, sums);
    Eigen::Matrix<double, kDiscParameters, kUnknowns> chain =
        Eigen::Matrix<double, kDiscParameters, kUnknowns>::Zero();
    for (const DiscParameter k : {kDiscX, kDiscY, kDiscRadius}) chain(k, k) = 1.0;
    for (const DiscParameter k : {kDiscAmbient, kDiscLightX, kDiscLightY, kDiscLightZ}) {
      chain(k, k) = brightness_over_colour_;
      chain(k, kRatio) = p_[k];
    }
    chain(kDiscAround, kSecondAround) = 1.0;
    system.normal += brightness_weight_ * (chain.transpose() * normalOf<kDiscParameters>(sums) * chain);
    system.gradient +=
        brightness_weight_ * (chain.transpose() * Eigen::Map<const ModelVector>(sums.gradient.data()));
    system.count += sums.count;
    system.squares += brightness_weight_ * sums.squares;
  }
  system.normal.diagonal().array() += 1e-9;
  const double ambient = p_[kDiscAmbient], prior = lightPrior(ambient);
  system.normal(kDiscLightZ, kDiscLightZ) += prior;
  system.gradient[kDiscLightZ] -= prior * p_[kDiscLightZ];
  return system;
}

bool DiscFit::descend(int steps) {
  for (int step = 0; step < steps; ++step) {
    const System system = linearise();
    if (!(system.count > kUnknowns)) return false;
    Vector change = system.normal.ldlt().solve(system.gradient);
    const double moved = std::sqrt(change.head<3>().squaredNorm()), most = 0.4 * p_[kDiscRadius];
    if (!(moved < 1e6)) return false;
    if (moved > most) change *= most / moved;
    for (int k = 0; k < kDiscParameters; ++k)
      p_[static_cast<std::size_t>(k)] += static_cast<float>(change[k]);
    brightness_over_colour_ += static_cast<float>(change[kRatio]);
    brightness_around_ += static_cast<float>(change[kSecondAround]);
    if (!(p_[kDiscRadius] > kSmallestDisc)) return false;
    if (step > 1 && moved < kSettled) break;
  }
  return true;
}

std::optional<Disc> DiscFit::result() {
  const System system = linearise();
  double seen = 0.0;
  for (std::size_t i = 0; i < real_count_; ++i)
    if (is_marked_[placeOf(i)] == 0 && givenAt(colour_->x[i], colour_->y[i]) != 0.0F)
      seen += colour_->cover[i];
  const double variance = std::max(kLeastVariance, system.squares / std::max(1.0, system.count - kUnknowns));
  const double contrast = p_[kDiscAmbient] + std::max(0.0F, p_[kDiscLightZ]) - p_[kDiscAround];
  const double noise = noiseAround();
  if (variance > noise * noise + kWorstMisfit * kWorstMisfit * contrast * contrast) return std::nullopt;
  const Normal inverse = system.normal.ldlt().solve(Normal::Identity());
  return believed(variance * inverse.topLeftCorner<2, 2>(), seen);
}

std::optional<Disc> DiscFit::believed(const Eigen::Matrix2d& covariance, double seen) const {
  Disc disc;
  disc.centre = {left_ + static_cast<double>(p_[kDiscX]), top_ + static_cast<double>(p_[kDiscY])};
  disc.covariance = covariance;
  disc.radius = p_[kDiscRadius];
  // What of the disc lies outside of the fitted cells is hidden, too.
  disc.seen_share = std::clamp(seen / (kPi * disc.radius * disc.radius), 0.0, 1.0);
  if (isDoubtful(disc)) return std::nullopt;
  const double trace = disc.covariance.trace();
  if (!(trace > 0.0 && trace < disc.radius * disc.radius)) return std::nullopt;
  return disc;
}

int DiscFit::traceOutline(std::span<OutlinePoint> outline) const {
  constexpr double kStep = 0.5;
  const double level = 0.5 * (p_[kDiscAmbient] + p_[kDiscAround]);
  const double farthest = binary_.radius + binary_.radius + kMargin;
  int count = 0;
  for (const auto& [nx, ny] : kDirections) {
    double before = valueAt(binary_.centre.x, binary_.centre.y);
    for (double d = kStep; d < farthest; d += kStep) {
      const double x = binary_.centre.x + d * nx, y = binary_.centre.y + d * ny;
      if (x < 0.0 || y < 0.0 || x > width_ - 1 || y > height_ - 1) break;
      const double here = valueAt(x, y);
      if (before >= level && here < level) {
        const double at = d - kStep + kStep * (before - level) / (before - here);
        outline[static_cast<std::size_t>(count++)] = {binary_.centre.x + at * nx, binary_.centre.y + at * ny};
        break;
      }
      before = here;
    }
  }
  return count;
}

bool DiscFit::isDoubtful(const Disc& disc) const {
  if (binary_.radius < kLarge || neighbour_) return false;
  const double dx = p_[kDiscX] - binary_.centre.x, dy = p_[kDiscY] - binary_.centre.y;
  return disc.seen_share < kLargeSeen ||
         std::abs(disc.radius - binary_.radius) > kLargeApart * binary_.radius ||
         dx * dx + dy * dy > kLargeApart * kLargeApart * binary_.radius * binary_.radius;
}

bool DiscFit::isDoubtful(const SmearedBall& ball, const SmearStart& start, const Smear& smear) const {
  if (binary_.radius < kLarge) return false;
  const double apart = kLargeApart * start.radius;
  return smear.one_sided || std::abs(ball.radius - start.radius) > apart ||
         (ball.centre - start.middle).squaredNorm() > apart * apart;
}

bool DiscFit::isPlausible() const {
  const double dx = p_[kDiscX] - binary_.centre.x, dy = p_[kDiscY] - binary_.centre.y;
  const double radius = p_[kDiscRadius],
               contrast = p_[kDiscAmbient] + std::max(0.0F, p_[kDiscLightZ]) - p_[kDiscAround];
  return dx * dx + dy * dy < binary_.radius * binary_.radius && radius > 0.6 * binary_.radius &&
         radius < 2.0 * binary_.radius && contrast > kLeastContrast;
}

}  // namespace helical
