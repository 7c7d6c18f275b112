#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/markers/ball_outline.h"
#include "engine/markers/ball_window.h"
#include "engine/markers/disc_kernels.h"

namespace helical {

/// The whole disc of DiscFit's model at rest, fitted to a window's cells: Gauss and Newton over the centre,
/// the radius, the light and the level around it; to the colour, and where the surroundings are even to the
/// brightness as well, with the same light and a level of its own, each cell of both by the scatter around
/// the fit. Cells from the window's corner on. Repeats bit for bit. No allocation.
class ShadedDisc {
 public:
  struct Quality {
    Eigen::Matrix2d covariance =
        Eigen::Matrix2d::Identity();  ///< of the centre, by the scatter of the residuals
    double variance = 0.0;            ///< of the residuals
  };

  explicit ShadedDisc(BallWindow& window) : window_(window) {}

  const DiscValues& parameters() const { return p_; }
  double radius() const { return p_[kDiscRadius]; }
  Eigen::Vector2d centre() const { return {p_[kDiscX], p_[kDiscY]}; }
  /// Of the ball where it faces the camera, over what is around it.
  double contrast() const;
  /// Halfway between the ball's ambient light and what is around it.
  double level() const { return 0.5 * (p_[kDiscAmbient] + p_[kDiscAround]); }

  /// A flat disc there, of the colour alone.
  void start(const OutlineCircle& circle);
  void start(const DiscValues& parameters);
  /// Takes the brightness in, of cells where it is even; false if too few of the outline are.
  bool startBrightness();
  /// To the least squares near to where it stands; false if there are none.
  bool descend(int steps);
  /// Marks and leaves out what does not fit because something is before the disc, and gives all other cells;
  /// false if these are the cells that were marked already.
  bool leaveOutHidden();

  Quality quality();
  /// Standard deviation of the colour's residuals around the disc.
  double noise();
  /// Whether the residuals are noise.
  bool fitsEverywhere();
  /// Chi-square of the residuals over what is expected of noise alone.
  double excess();
  /// About how much chi-square a motion of the ball would take off what it leaves at rest, by the score test:
  /// by the slopes at rest, with all other unknowns free, in the direction where it is most.
  double gainOfMotion();
  /// Of the disc, not marked and not the neighbour's.
  double seenCells() const;

 private:
  /// The unknowns: those of the model, and of the brightness its level over that of the colour, and the level
  /// around it.
  static constexpr int kRatio = kDiscParameters, kSecondAround = kRatio + 1, kUnknowns = kSecondAround + 1;

  /// The normal equations at the current parameters.
  struct System {
    Eigen::Matrix<double, kUnknowns, kUnknowns> normal;
    Eigen::Matrix<double, kUnknowns, 1> gradient;
    double count = 0.0;  ///< of the values
    double squares = 0.0;
  };

  bool hasBrightness() const { return brightness_weight_ > 0.0; }
  int unknowns() const { return hasBrightness() ? kUnknowns : kDiscParameters; }
  /// With the cells' residuals at the current parameters.
  const System& system();
  void addBrightness(const DiscSums& sums);
  Eigen::Matrix<double, kUnknowns, 1> step();
  void levelBrightness();

  BallWindow& window_;
  DiscValues p_{};
  SecondPicture brightness_;
  double brightness_weight_ = 0.0;  ///< of a cell's brightness, over that of its colour; 0: not fitted
  System system_;
  bool is_current_ = false;  ///< the system
  std::optional<double> noise_;
};

}  // namespace helical
