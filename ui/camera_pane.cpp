#include "ui/camera_pane.h"

#include <QContextMenuEvent>
#include <QCoreApplication>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "ui/camera_tools.h"
#include "ui/camera_view.h"
#include "ui/format.h"
#include "ui/panel_title.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

// px of a pane's title
constexpr int kRoomForBoard = 330;
constexpr int kRoomForTools = 270;

/// What the device has taken; nothing of sources that do not tell.
QString exposureText(const LightSetting& light) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("CameraPane", text); };
  QStringList parts;
  if (light.exposure_us > 0.0) parts += tr("EXP %1 ms").arg(plainNumber(1e-3 * light.exposure_us, 1));
  if (std::isfinite(light.gain))
    parts += light.gain_in_db ? tr("GAIN %1 dB").arg(plainNumber(light.gain, 1))
                              : tr("GAIN %1").arg(plainNumber(light.gain, 0));
  return parts.join(QStringLiteral("  "));
}

}  // namespace

CameraPane::CameraPane(CameraId camera, const RigConfig& rig, QWidget* parent)
    : QWidget(parent), camera_(camera) {
  const CameraConfig& config = rig.cameras[static_cast<std::size_t>(camera.index())];
  for (const CameraConfig& each : rig.cameras) names_ << QString::fromStdString(each.name);
  name_ = names_[camera.index()];
  title_ = new PanelTitle(name_, theme::cameraColor(camera.index()), this);
  focal_length_px_ = config.model.fx();
  buildTools(config, config.source != "sim" || rig.simulation.images);
  board_button_ = addButton(tr("Board"));
  board_button_->setCheckable(true);
  board_button_->setToolTip(
      tr("Then drag over the picture: a white board covers that part of it. Drag the board "
         "to move it, click its cross to take it away."));
  board_button_->setAccessibleName(tr("White board before %1").arg(name_));
  tools_button_ = addButton(tr("Tools"));
  tools_button_->setMenu(tools_);
  tools_button_->setPopupMode(QToolButton::InstantPopup);
  tools_button_->setToolTip(tr("Boards, lost frames, noise, knocks; masks, trails, colour of the markers"));
  tools_button_->setAccessibleName(tr("Tools of %1").arg(name_));
  button_ = addButton({});
  view_ = new CameraView(theme::on_dark::cameraColor(camera.index()),
                         QSize(config.model.width(), config.model.height()), rig.markers_in_body.count());
  PictureMasks masks;
  masks.range = rig.marker_options;
  masks.background_threshold = rig.marker_options.background_threshold;
  view_->setMasks(masks);
  view_->setAccessibleName(tr("Picture of %1").arg(name_));

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(title_);
  layout->addWidget(view_, 1);

  connect(button_, &QToolButton::clicked, this, [this] { Q_EMIT hideRequested(camera_, !hidden_); });
  connect(board_button_, &QToolButton::clicked, this, [this](bool on) {
    view_->setBoardTool(on ? BoardEditor::Tool::kRectangle : BoardEditor::Tool::kNone);
  });
  connect(view_, &CameraView::boardToolChanged, this,
          [this] { board_button_->setChecked(view_->boardTool() != BoardEditor::Tool::kNone); });
  connect(view_, &CameraView::boardsChanged, this,
          [this](const WhiteBoards& boards) { Q_EMIT boardsChanged(camera_, boards); });
  connect(view_, &CameraView::firstImagePainted, this, &CameraPane::firstImagePainted);
  connectTools();
  setHidden(false);
}

QToolButton* CameraPane::addButton(const QString& text) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setObjectName("small");
  button->setFont(theme::uiFont(8, QFont::Medium));
  button->setFixedSize(50, 19);
  button->setFocusPolicy(Qt::TabFocus);
  title_->addWidget(button);
  return button;
}

void CameraPane::buildTools(const CameraConfig& config, bool images) {
  tools_ = new CameraTools(name_, config.source == "sim", images, this);
  connect(tools_, &CameraTools::hideRequested, this, [this](bool on) { Q_EMIT hideRequested(camera_, on); });
  connect(tools_, &CameraTools::lossRequested, this,
          [this](double share) { Q_EMIT lossRequested(camera_, share); });
  connect(tools_, &CameraTools::noiseRequested, this,
          [this](double grey_levels, double px) { Q_EMIT noiseRequested(camera_, grey_levels, px); });
  connect(tools_, &CameraTools::knockRequested, this, [this](double angle_deg, double distance_m) {
    Q_EMIT knockRequested(camera_, angle_deg, distance_m);
  });
  connect(tools_, &CameraTools::pickRequested, this, &CameraPane::pickRequested);
}

void CameraPane::connectTools() {
  connect(tools_, &CameraTools::boardToolChosen, view_, &CameraView::setBoardTool);
  connect(tools_, &CameraTools::boardsCleared, view_, &CameraView::clearBoards);
  connect(tools_, &CameraTools::magnificationChosen, view_, &CameraView::setMagnification);
  connect(tools_, &CameraTools::trailsToggled, view_, &CameraView::setTrailsShown);
  connect(tools_, &CameraTools::masksToggled, this, [this](bool background, bool colour) {
    PictureMasks masks = view_->masks();
    masks.background = background;
    masks.colour = colour_mask_ = colour;
    view_->setMasks(masks);
  });
  connect(view_, &CameraView::colourPicked, this,
          [this](const Eigen::Vector2d& pixel) { Q_EMIT colourPicked(camera_, pixel); });
}

void CameraPane::previewColour(const ColourRange& range, bool picking) {
  PictureMasks masks = view_->masks();
  masks.range = range;
  masks.colour = picking || colour_mask_;
  view_->setMasks(masks);
  view_->setPickingColour(picking);
}

void CameraPane::contextMenuEvent(QContextMenuEvent* event) {
  tools_->popup(event->globalPos());
}

void CameraPane::resizeEvent(QResizeEvent*) {
  board_button_->setVisible(width() >= kRoomForBoard);
  tools_button_->setVisible(width() >= kRoomForTools);
}

void CameraPane::addTrack(const CameraTrack& track) {
  view_->addTrack(track);
}

void CameraPane::setPicture(const CameraPicture& picture) {
  view_->setPicture(picture);
}

void CameraPane::setState(const CameraSnapshot& state, const EngineSnapshot& now) {
  if (state.hidden != hidden_) setHidden(state.hidden);
  setBadge(state);
  tools_->show(state);
  view_->setExposure(exposureText(state.light));
  if (state.frames == 0) {
    title_->setNote(tr("no frames"));
    view_->setCaptions({}, {});
    return;
  }
  const QString rate = tr("%1 fps").arg(plainNumber(state.frames_per_second, 0));
  title_->setNote(QStringLiteral("%1  %2 ms").arg(rate, milliseconds(state.latency, 0)), rate);

  // A camera that fell silent must not look as if it still saw something.
  const bool fresh = now.time - state.track.exposure < kNanosecondsPerSecond;
  QString seen = fresh ? tr("%1 seen  %2 used").arg(state.centroids).arg(state.track.selected_count)
                       : tr("nothing new for over 1 s");
  if (state.dropped > 0) seen += tr("  %1 dropped").arg(state.dropped);
  const CameraId stream = now.streams[static_cast<std::size_t>(camera_.index())];
  if (stream != camera_) seen += tr("  by the cable of %1").arg(names_[stream.index()]);
  const bool used = fresh && state.track.selected_count > 0;
  view_->setCaptions(seen, used ? residualText(state, now) : QString());
}

QString CameraPane::residualText(const CameraSnapshot& state, const EngineSnapshot& now) const {
  const Eigen::Vector3d in_camera =
      state.estimate.camera_from_world * now.tracked.state.world_from_body.translation;
  const double millimetres = 1e3 * state.track.residual_px * in_camera.z() / focal_length_px_;
  return tr("residual %1 px  %2 mm")
      .arg(plainNumber(state.track.residual_px, 2), plainNumber(millimetres, 1));
}

void CameraPane::setBadge(const CameraSnapshot& state) {
  StatusWord word =
      state.hidden ? StatusWord{tr("Hidden"), theme::kCaution} : cameraStatusWord(state.estimate.status);
  const double variance = state.estimate.covariance.bottomRightCorner<3, 3>().trace();
  if (!state.hidden && state.calibration_method != nullptr && variance > 0.0)
    word.text += tr(" %1 mm").arg(plainNumber(1e3 * std::sqrt(variance), 0));
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
