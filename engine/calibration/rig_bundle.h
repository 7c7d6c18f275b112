#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/calibration/rig_moment.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

struct RigBundleOptions {
  int iterations = 25;
  double robust_sigmas = 4.0;     ///< residuals beyond weigh (this / residual)^4
  double marker_sigma_m = 0.0;    ///< how far balls may be off their places, per axis; 0: they are where they are
  double focal_sigma = 0.0;       ///< how far focal lengths may be off, as a share; 0: they are what they are
};

/// Throws Error(kInput) naming the offending key.
void validate(const RigBundleOptions& options);

/// One camera's part in a bundle adjustment.
struct BundleCamera {
  bool used = false;
  bool given = false;              ///< its pose is known, up to `covariance`
  RigidTransform camera_from_world;  ///< first guess, then the answer
  Matrix6d covariance = Matrix6d::Zero();  ///< of a given one; of all, in the answer
  bool focal_is_given = false;     ///< it is what it is, whatever the options say
  double focal_scale = 1.0;        ///< by which both focal lengths are multiplied; what the prior says, then the answer
  double focal_sigma = 0.0;        ///< of that; in the answer
  int balls = 0, inliers = 0;      ///< seen, and explained within `robust_sigmas`
};

/// All cameras of a rig at once, and on demand the balls' places on the helicopter and the focal lengths: minimises
/// the reprojection error over them and over the helicopter's pose at every moment (bundle adjustment). The poses
/// are minimised over for each set of the other parameters (variable projection), so that what is solved for stays
/// small however many moments there are; Levenberg-Marquardt over the rest, robust, with a scale that follows the
/// median residual while the fit is poor.
///
/// The gauge is held by cameras with a given pose or by moments with a given one. Balls that move have one of their
/// own: as a whole they may shift and turn against the body, and where no given camera sets the scale grow against
/// it, and no image shows it. The prior holds that: nothing shifts, turns or grows but what images ask for. A focal
/// length is told from the distance only by what comes nearer and goes away; its prior holds the rest. Works in
/// slices, so that no image waits for it; allocates at construction only. One thread.
class RigBundle {
 public:
  /// For at most `moments` moments.
  RigBundle(std::vector<CameraModel> cameras, const MarkerLayout& markers, int moments);

  /// From the next run on the balls are here, or here as far as the prior says. As many as before.
  void expect(const MarkerLayout& markers) { initial_layout_ = markers; }

  /// `moments` stay where they are until it is done; their poses are refined in place.
  void start(std::span<RigMoment> moments, std::span<const BundleCamera> cameras, const RigBundleOptions& options);
  void stop() { state_ = State::kIdle; }

  bool running() const { return state_ == State::kEvaluating; }
  /// Looks at so many moments, then goes on in the next call. True when it is done.
  bool advance(int moments);

  /// Of a run that is done.
  bool succeeded() const { return state_ == State::kDone; }
  std::span<const BundleCamera> cameras() const { return cameras_; }
  const MarkerLayout& markers() const { return layout_; }
  double medianSigmas() const { return current_.median_sigmas; }  ///< 1.18 where noise is as told
  /// By how much the cost is lower for the balls and focal lengths found than for these, with all else free
  /// either way, over what noise of the size found explains: about the number of `freedoms` where these stand
  /// right, chi-square distributed.
  double gainOver(const MarkerLayout& balls, std::span<const double> focal_scales) const;
  int freedoms() const { return freedoms_; }
  /// Share of the images of a ball that are explained within `robust_sigmas`; 1 where it was not seen.
  double fitting(MarkerId ball) const;

 private:
  enum class State { kIdle, kEvaluating, kDone, kFailed };
  struct Parameters {
    std::array<RigidTransform, kMaxCameras> cameras;
    std::array<double, kMaxCameras> focal_scales;
    std::array<Eigen::Vector3d, kMaxMarkers> markers;
  };
  struct Sum {
    Eigen::MatrixXd hessian;  ///< the first `columns_` of each are in use
    Eigen::VectorXd gradient;
    double cost = 0.0;
    double median_sigmas = 0.0;
    std::array<int, kMaxCameras> balls{}, inliers{};
    std::array<int, kMaxMarkers> seen{}, fitting{};  ///< of each ball
    void clear();
  };
  /// One ball in one image under the parameters.
  struct Term {
    Eigen::Vector2d residual = Eigen::Vector2d::Zero();
    Eigen::Matrix<double, 2, 6> d_camera = Eigen::Matrix<double, 2, 6>::Zero();
    Eigen::Matrix<double, 2, 6> d_pose = Eigen::Matrix<double, 2, 6>::Zero();
    Eigen::Matrix<double, 2, 3> d_marker = Eigen::Matrix<double, 2, 3>::Zero();
    Eigen::Vector2d d_focal = Eigen::Vector2d::Zero();
  };

  void layOut();
  void beginPass(const Parameters& parameters);
  void endPass();
  void propose();
  void finish();
  /// Of the current normal equations, into `factor_`. False if they determine no answer.
  bool factorise(double damping);
  std::optional<Term> project(std::size_t camera, int marker, const RigMoment& moment, bool derivatives) const;
  void fitPose(RigMoment& moment) const;
  void add(RigMoment& moment);
  void addPriors();
  double weight(double squared, double& cost) const;

  std::vector<CameraModel> models_;
  MarkerLayout layout_, initial_layout_;
  std::span<RigMoment> moments_;
  std::vector<RigidTransform> poses_;  ///< of the best parameters, to go back to
  std::vector<BundleCamera> cameras_;
  std::vector<BundleCamera> given_;
  RigBundleOptions options_;
  State state_ = State::kIdle;
  Parameters best_, trial_;
  Sum current_, sum_;
  Eigen::MatrixXd coupling_;      ///< 6 rows: helicopter pose by parameters, of one moment
  Eigen::VectorXd step_;
  Eigen::MatrixXd factor_, inverse_;
  std::vector<float> distances_;  ///< squared residuals of a pass [sigma^2]
  std::array<int, kMaxCameras> camera_column_{}, focal_column_{};
  int marker_column_ = -1, columns_ = 0;
  int moved_column_ = 0;  ///< from here on are focal lengths and balls
  double misfit_ = 1.0;   ///< variance over the one told, where even the answer fits badly
  int freedoms_ = 0;
  std::size_t next_ = 0;
  bool first_ = true;
  int iteration_ = 0;
  double damping_ = 1e-3, scale_ = 4.0;
};

}  // namespace helical
