#include "ui/camera_tools.h"

#include <QActionGroup>
#include <array>

namespace helical {
namespace {

constexpr std::array<double, 5> kLosses{0.0, 0.1, 0.3, 0.6, 1.0};

struct Noise {
  double grey_levels;
  double px;
};
constexpr std::array<Noise, 4> kNoises{{{0.0, 0.0}, {8.0, 0.5}, {20.0, 1.5}, {45.0, 4.0}}};

struct Knock {
  const char* text;
  double angle_deg;
  double distance_m;
};
constexpr std::array<Knock, 2> kKnocks{
    {{QT_TRANSLATE_NOOP("helical::CameraTools", "Knock lightly (2 deg, 2 cm)"), 2.0, 0.02},
     {QT_TRANSLATE_NOOP("helical::CameraTools", "Knock hard (10 deg, 20 cm)"), 10.0, 0.20}}};

}  // namespace

CameraTools::CameraTools(const QString& camera_name, bool simulated, bool images, QWidget* parent)
    : QMenu(camera_name, parent), hide_(addAction(tr("Hide from the tracker"))) {
  setAccessibleName(tr("Tools of %1").arg(camera_name));
  hide_->setCheckable(true);
  connect(hide_, &QAction::triggered, this, &CameraTools::hideRequested);
  addSeparator();
  buildBoards();
  buildLoss();
  buildNoise(images);
  if (simulated) buildKnocks();
  addActions(disturbances_);
  addSeparator();
  buildPicture(images);
}

void CameraTools::buildBoards() {
  const auto add = [this](const QString& text, const auto& act) {
    auto* action = new QAction(text, this);
    connect(action, &QAction::triggered, this, act);
    disturbances_.push_back(action);
  };
  add(tr("Draw a white board"), [this] { Q_EMIT boardToolChosen(BoardEditor::Tool::kRectangle); });
  add(tr("Draw a white board by free hand"),
      [this] { Q_EMIT boardToolChosen(BoardEditor::Tool::kFreeHand); });
  add(tr("Take all boards away"), [this] { Q_EMIT boardsCleared(); });
}

void CameraTools::buildLoss() {
  auto* menu = new QMenu(tr("Lose frames"), this);
  auto* group = new QActionGroup(this);
  for (const double share : kLosses) {
    QAction* action = menu->addAction(share > 0.0 ? tr("%1 %").arg(100.0 * share) : tr("None"));
    action->setCheckable(true);
    action->setData(share);
    group->addAction(action);
    connect(action, &QAction::triggered, this, [this, share] { Q_EMIT lossRequested(share); });
    losses_.push_back(action);
  }
  disturbances_.push_back(menu->menuAction());
}

void CameraTools::buildNoise(bool images) {
  auto* menu = new QMenu(tr("Noise"), this);
  auto* group = new QActionGroup(this);
  for (const Noise& noise : kNoises) {
    const double shown = images ? noise.grey_levels : noise.px;
    const QString unit = images ? tr("%1 grey levels") : tr("%1 px");
    QAction* action = menu->addAction(shown > 0.0 ? unit.arg(shown) : tr("None"));
    action->setCheckable(true);
    action->setData(shown);
    group->addAction(action);
    connect(action, &QAction::triggered, this,
            [this, noise] { Q_EMIT noiseRequested(noise.grey_levels, noise.px); });
    noises_.push_back(action);
  }
  disturbances_.push_back(menu->menuAction());
}

void CameraTools::buildKnocks() {
  for (const Knock& knock : kKnocks) {
    auto* action = new QAction(tr(knock.text), this);
    connect(action, &QAction::triggered, this,
            [this, knock] { Q_EMIT knockRequested(knock.angle_deg, knock.distance_m); });
    disturbances_.push_back(action);
  }
}

void CameraTools::buildPicture(bool images) {
  QMenu* errors = addMenu(tr("Errors drawn larger"));
  auto* group = new QActionGroup(this);
  for (const int times : {1, 10, 50, 200}) {
    QAction* action = errors->addAction(tr("%1 times").arg(times));
    action->setCheckable(true);
    action->setChecked(times == 50);
    group->addAction(action);
    connect(action, &QAction::triggered, this, [this, times] { Q_EMIT magnificationChosen(times); });
  }
  QAction* trails = addAction(tr("Trails of the markers"));
  trails->setCheckable(true);
  trails->setChecked(true);
  connect(trails, &QAction::toggled, this, &CameraTools::trailsToggled);
  if (!images) return;
  QAction* background = addAction(tr("Background mask"));
  QAction* colour = addAction(tr("Colour mask"));
  for (QAction* mask : {background, colour}) {
    mask->setCheckable(true);
    connect(mask, &QAction::toggled, this, [this, background, colour] {
      Q_EMIT masksToggled(background->isChecked(), colour->isChecked());
    });
  }
  addAction(tr("Pick the markers' colour\u2026"), this, &CameraTools::pickRequested);
}

void CameraTools::show(const CameraSnapshot& state) {
  hide_->setChecked(state.hidden);
  for (QAction* action : losses_) action->setChecked(action->data().toDouble() == state.lost_share);
  for (QAction* action : noises_) action->setChecked(action->data().toDouble() == state.noise);
}

}  // namespace helical
