#include "ui/camera_pane.h"

#include <QToolButton>
#include <QVBoxLayout>

#include "ui/camera_view.h"
#include "ui/format.h"
#include "ui/panel_title.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {

CameraPane::CameraPane(CameraId camera, const CameraConfig& config, int marker_count, QWidget* parent)
    : QWidget(parent), camera_(camera), name_(QString::fromStdString(config.name)) {
  const QColor identity = theme::cameraColor(camera.index());
  title_ = new PanelTitle(name_, identity, this);
  button_ = new QToolButton;
  button_->setObjectName("small");
  button_->setFont(theme::uiFont(8, QFont::Medium));
  button_->setFixedSize(50, 19);
  button_->setFocusPolicy(Qt::TabFocus);
  title_->addWidget(button_);
  view_ = new CameraView(identity, QSize(config.model.width(), config.model.height()), marker_count);
  view_->setAccessibleName(tr("Picture of %1").arg(name_));

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(title_);
  layout->addWidget(view_, 1);

  connect(button_, &QToolButton::clicked, this, [this] { Q_EMIT hideRequested(camera_, !hidden_); });
  connect(view_, &CameraView::firstImagePainted, this, &CameraPane::firstImagePainted);
  setHidden(false);
}

void CameraPane::addTrack(const CameraTrack& track) {
  view_->addTrack(track);
}

void CameraPane::setPicture(const CameraPicture& picture) {
  view_->setPicture(picture);
}

void CameraPane::setState(const CameraSnapshot& state, TimeNs now) {
  if (state.hidden != hidden_) setHidden(state.hidden);
  setBadge(state);
  if (state.frames == 0) {
    title_->setNote(tr("no frames"));
    view_->setCaptions({}, {});
    return;
  }
  const QString rate = tr("%1 fps").arg(plainNumber(state.frames_per_second, 1));
  title_->setNote(QStringLiteral("%1  %2 ms").arg(rate, milliseconds(state.latency, 1)), rate);

  // A camera that fell silent must not look as if it still saw something.
  const bool fresh = now - state.track.exposure < kNanosecondsPerSecond;
  QString seen = fresh ? tr("%1 seen  %2 used").arg(state.centroids).arg(state.track.selected_count)
                       : tr("nothing new for over 1 s");
  if (state.dropped > 0) seen += tr("  %1 dropped").arg(state.dropped);
  const bool used = fresh && state.track.selected_count > 0;
  view_->setCaptions(seen,
                     used ? tr("residual %1 px").arg(plainNumber(state.track.residual_px, 2)) : QString());
}

void CameraPane::setBadge(const CameraSnapshot& state) {
  const StatusWord word =
      state.hidden ? StatusWord{tr("Hidden"), theme::kCaution} : cameraStatusWord(state.estimate.status);
  title_->setBadge(word.text, word.color);
}

void CameraPane::setHidden(bool hidden) {
  hidden_ = hidden;
  view_->setHidden(hidden);
  button_->setText(hidden ? tr("Show") : tr("Hide"));
  button_->setToolTip(hidden ? tr("Let the tracker use %1 again").arg(name_)
                             : tr("Throw away what %1 sees, as if it were covered").arg(name_));
  button_->setAccessibleName(hidden ? tr("Show %1").arg(name_) : tr("Hide %1").arg(name_));
}

}  // namespace helical
