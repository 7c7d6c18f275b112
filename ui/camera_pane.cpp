#include "ui/camera_pane.h"

#include <QAction>
#include <QContextMenuEvent>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>
#include <array>
#include <cmath>

#include "ui/camera_view.h"
#include "ui/format.h"
#include "ui/panel_title.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kRoomForBoard = 270;  // px of a pane's title

struct KnockChoice {
  const char* text;
  double angle_deg;
  double distance_m;
};
constexpr std::array<KnockChoice, 2> kKnocks{
    {{QT_TRANSLATE_NOOP("CameraPane", "Knock lightly (2 deg, 2 cm)"), 2.0, 0.02},
     {QT_TRANSLATE_NOOP("CameraPane", "Knock hard (10 deg, 20 cm)"), 10.0, 0.20}}};

}  // namespace

CameraPane::CameraPane(CameraId camera, const CameraConfig& config, int marker_count, QWidget* parent)
    : QWidget(parent),
      camera_(camera),
      name_(QString::fromStdString(config.name)),
      title_(new PanelTitle(name_, theme::cameraColor(camera.index()), this)),
      focal_length_px_(config.model.fx()) {
  board_button_ = addButton(tr("Board"));
  board_button_->setCheckable(true);
  board_button_->setToolTip(
      tr("Then drag over the picture: a white board covers that part of it. Drag the board "
         "to move it, click its cross to take it away."));
  board_button_->setAccessibleName(tr("White board before %1").arg(name_));
  button_ = addButton({});
  view_ = new CameraView(theme::cameraColor(camera.index()),
                         QSize(config.model.width(), config.model.height()), marker_count);
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
  buildDisturbances(config.source == "sim");
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

void CameraPane::buildDisturbances(bool simulated) {
  const auto add = [this](const QString& text, const auto& act) {
    auto* action = new QAction(text, this);
    connect(action, &QAction::triggered, this, act);
    disturbances_.push_back(action);
  };
  add(tr("Draw a white board"), [this] { view_->setBoardTool(BoardEditor::Tool::kRectangle); });
  add(tr("Draw a white board by free hand"), [this] { view_->setBoardTool(BoardEditor::Tool::kFreeHand); });
  add(tr("Take all boards away"), [this] { view_->clearBoards(); });
  if (!simulated) return;
  for (const auto& [text, angle_deg, distance_m] : kKnocks)
    add(tr(text), [this, angle_deg = angle_deg, distance_m = distance_m] {
      Q_EMIT knockRequested(camera_, angle_deg, distance_m);
    });
}

void CameraPane::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu;
  menu.addAction(button_->text() == tr("Show") ? tr("Show %1").arg(name_) : tr("Hide %1").arg(name_), button_,
                 &QToolButton::click);
  menu.addSeparator();
  menu.addActions(disturbances_);
  menu.addSeparator();
  QMenu* errors = menu.addMenu(tr("Errors drawn larger"));
  for (const int times : {1, 10, 50, 200})
    errors->addAction(tr("%1 times").arg(times), view_, [this, times] { view_->setMagnification(times); });
  menu.exec(event->globalPos());
}

void CameraPane::resizeEvent(QResizeEvent*) {
  board_button_->setVisible(width() >= kRoomForBoard);
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
