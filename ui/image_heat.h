#pragma once

#include <QPointF>
#include <QSize>
#include <array>

#include "engine/tracking/track.h"

namespace helical {

/// Where in one camera's image used markers were seen, and how far off they were there: a grid of cells.
/// Tells which parts of the image no calibration has seen yet, and lens errors, which grow towards its
/// corners.
class ImageHeat {
 public:
  static constexpr int kColumns = 16;
  static constexpr int kRows = 12;

  explicit ImageHeat(QSize sensor) : sensor_(sensor) {}

  /// Every frame once; a track that was added last is ignored.
  void add(const CameraTrack& track, int marker_count);
  void clear();

  /// The middle of a cell; pixel centres are whole numbers [px].
  QPointF middle(int column, int row) const;

  int count(int column, int row) const { return cell(column, row).count; }
  int largestCount() const;
  /// RMS of the distance from measured to expected [px]; NaN where nothing was seen.
  double residual(int column, int row) const;
  double largestResidual() const;  ///< 0 when nothing was seen
  /// Share of the cells in which something was seen.
  double covered() const;

 private:
  struct Cell {
    int count = 0;
    double squares = 0.0;
  };
  const Cell& cell(int column, int row) const {
    return cells_[static_cast<std::size_t>(row * kColumns + column)];
  }

  QSize sensor_;
  TimeNs newest_ = 0;
  std::array<Cell, kColumns * kRows> cells_{};
};

}  // namespace helical
