#include "ui/camera_overlay.h"

#include <Eigen/Eigenvalues>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kSmallestRing = 7.0;
constexpr double kTrailSeconds = 1.2;
constexpr double kLongestGap = 60.0;  // px of the image: farther apart it is not one way

/// Screen position of an image point: pixel (0, 0) is the centre of the first pixel.
QPointF toScreen(const Eigen::Vector2d& pixel, double scale) {
  return {(pixel.x() + 0.5) * scale, (pixel.y() + 0.5) * scale};
}

const Centroid* centroidAt(const Observation* observation, const Eigen::Vector2d& pixel) {
  if (observation == nullptr) return nullptr;
  const Centroid* best = nullptr;
  double nearest = 3.0;
  for (int i = 0; i < observation->count; ++i) {
    const Centroid& centroid = observation->centroids[static_cast<std::size_t>(i)];
    const double distance = (centroid.pixel - pixel).norm();
    if (distance < nearest) {
      nearest = distance;
      best = &centroid;
    }
  }
  return best;
}

void paintRing(QPainter& painter, const QPointF& center, double radius, const QColor& color) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(color, 1.5));
  painter.drawEllipse(center, radius, radius);
}

/// Writes the id on the ring's side that looks away from the other markers.
void paintLabel(QPainter& painter, const QPointF& center, double radius, const QPointF& outward,
                const QString& text, const QColor& color) {
  painter.setFont(theme::monoFont(7.4, QFont::DemiBold));
  const int width = painter.fontMetrics().horizontalAdvance(text) + 6;
  QRectF frame(0, 0, width, 13);
  frame.moveCenter(center + outward * (radius + 10.0));
  painter.fillRect(frame, QColor(8, 12, 16, 170));
  painter.setPen(color);
  painter.drawText(frame, Qt::AlignCenter, text);
}

void paintCross(QPainter& painter, const QPointF& center) {
  painter.setPen(QPen(QColor(255, 255, 255, 210), 1));
  painter.drawLine(center - QPointF(4, 0), center + QPointF(4, 0));
  painter.drawLine(center - QPointF(0, 4), center + QPointF(0, 4));
}

/// Three standard deviations, magnified.
void paintEllipse(QPainter& painter, const QPointF& center, const Eigen::Matrix2d& covariance, double scale,
                  const QColor& color) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);
  const Eigen::Vector2d radii = 3.0 * scale * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const Eigen::Vector2d along = axes.eigenvectors().col(0);
  painter.save();
  painter.translate(center);
  painter.rotate(toDegrees(std::atan2(along.y(), along.x())));
  QColor faint = color;
  faint.setAlpha(120);
  painter.setPen(QPen(faint, 1, Qt::DotLine));
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(QPointF(), radii.x(), radii.y());
  painter.restore();
}

/// From what was measured towards what was expected, magnified.
void paintResidual(QPainter& painter, const QPointF& center, const QPointF& residual, const QColor& color) {
  const double length = std::hypot(residual.x(), residual.y());
  if (length < 3.0) return;
  const QPointF tip = center + residual, along = residual / length, across(-along.y(), along.x());
  painter.setPen(QPen(color, 1.4));
  painter.drawLine(center, tip);
  painter.drawLine(tip, tip - 4.0 * along + 2.5 * across);
  painter.drawLine(tip, tip - 4.0 * along - 2.5 * across);
}

QPointF middleOfMarkers(const CameraOverlay& overlay, double scale) {
  QPointF sum;
  int count = 0;
  for (int i = 0; i < overlay.marker_count; ++i) {
    const MarkerTrack& marker = overlay.track->markers[static_cast<std::size_t>(i)];
    if (!marker.observed) continue;
    sum += toScreen(marker.pixel, scale);
    ++count;
  }
  return count > 0 ? sum / count : sum;
}

QPointF direction(const QPointF& from, const QPointF& to) {
  const QPointF delta = to - from;
  const double length = std::hypot(delta.x(), delta.y());
  return length > 1.0 ? delta / length : QPointF(0.0, -1.0);
}

bool isNamed(const CameraOverlay& overlay, const Eigen::Vector2d& pixel) {
  if (overlay.track == nullptr) return false;
  const auto begin = overlay.track->markers.begin();
  return std::any_of(begin, begin + overlay.marker_count, [&](const MarkerTrack& marker) {
    return marker.observed && (marker.pixel - pixel).norm() < 3.0;
  });
}

void paintUnnamedRegions(QPainter& painter, const CameraOverlay& overlay, double scale) {
  if (overlay.observation == nullptr) return;
  QColor color = theme::on_dark::kCaution;
  color.setAlpha(190);
  for (int i = 0; i < overlay.observation->count; ++i) {
    const Centroid& centroid = overlay.observation->centroids[static_cast<std::size_t>(i)];
    if (isNamed(overlay, centroid.pixel)) continue;
    paintRing(painter, toScreen(centroid.pixel, scale), std::max(5.0, centroid.radius_px * scale + 2), color);
  }
}

/// Fades with age.
void paintTrails(QPainter& painter, const CameraOverlay& overlay, double scale) {
  const TimeNs now = overlay.track->exposure;
  for (int i = 0; i < overlay.marker_count; ++i) {
    const MarkerTrack* before = nullptr;
    overlay.history->forTrail(now, kTrailSeconds, [&](const CameraTrack& track) {
      const MarkerTrack& marker = track.markers[static_cast<std::size_t>(i)];
      if (marker.observed && before != nullptr && (marker.pixel - before->pixel).norm() < kLongestGap) {
        const double age = toSeconds(now - track.exposure) / kTrailSeconds;
        painter.setPen(QPen(QColor(255, 255, 255, static_cast<int>(150 * (1.0 - age))), 1.2));
        painter.drawLine(toScreen(before->pixel, scale), toScreen(marker.pixel, scale));
      }
      before = marker.observed ? &marker : nullptr;
    });
  }
}

}  // namespace

void paintOverlay(QPainter& painter, const CameraOverlay& overlay, double scale) {
  painter.setRenderHint(QPainter::Antialiasing);
  paintUnnamedRegions(painter, overlay, scale);
  if (overlay.track == nullptr) return;
  if (overlay.history != nullptr) paintTrails(painter, overlay, scale);
  const QPointF middle = middleOfMarkers(overlay, scale);
  for (int i = 0; i < overlay.marker_count; ++i) {
    const MarkerTrack& marker = overlay.track->markers[static_cast<std::size_t>(i)];
    if (marker.observed) {
      const Centroid* centroid = centroidAt(overlay.observation, marker.pixel);
      const double radius = std::max(kSmallestRing, (centroid ? centroid->radius_px : 0.0) * scale + 3.0);
      const QColor color = marker.selected ? theme::on_dark::kHealthy : theme::on_dark::kCaution;
      const QPointF center = toScreen(marker.pixel, scale);
      paintRing(painter, center, radius, color);
      if (centroid) paintEllipse(painter, center, centroid->covariance, scale * overlay.magnification, color);
      if (marker.predicted)
        paintResidual(painter, center, overlay.magnification * (toScreen(marker.reprojected, scale) - center),
                      Qt::white);
      paintLabel(painter, center, radius, direction(middle, center), QString::number(i + 1), color);
    }
    if (marker.predicted) paintCross(painter, toScreen(marker.reprojected, scale));
  }
}

}  // namespace helical
