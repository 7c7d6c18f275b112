#include "ui/viewpoints.h"

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QToolButton>
#include <array>
#include <utility>

#include "ui/orbit_view.h"
#include "ui/panel_title.h"
#include "ui/scene_view.h"
#include "ui/small_button.h"

namespace helical {
Viewpoints::Viewpoints(const RigConfig& rig, SceneView& scene, QObject* parent)
    : QObject(parent), scene_(scene), group_(new QActionGroup(this)) {
  const std::array<std::pair<QString, QString>, 3> names{
      {{tr("Follow"), tr("The eye goes with the helicopter")},
       {tr("Top"), tr("From above, +x to the right")},
       {tr("Iso"), tr("All of the field, from the side")}}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    QAction* action = group_->addAction(names[i].first);
    action->setCheckable(true);
    action->setToolTip(names[i].second);
    action->setChecked(i == 0);
    connect(action, &QAction::triggered, this, [this, i] { scene_.look(static_cast<SceneViewpoint>(i)); });
    standing_.append(action);
  }
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    QAction* action = group_->addAction(tr("Through %1").arg(QString::fromStdString(rig.cameras[i].name)));
    action->setCheckable(true);
    connect(action, &QAction::triggered, this, [this, i] { scene_.lookThrough(cameraId(static_cast<int>(i))); });
    through_.append(action);
  }
}

QList<QAction*> Viewpoints::actions() const {
  return group_->actions();
}

void Viewpoints::lookFromTheSide() {
  standing_.at(static_cast<int>(SceneViewpoint::kIso))->trigger();
}

void Viewpoints::addButtons(PanelTitle& title) const {
  for (QAction* action : standing_) {
    QToolButton* button = smallButton({}, tr("%1 view").arg(action->text()), {});
    button->setDefaultAction(action);
    title.addWidget(button);
  }
  QToolButton* through = smallButton(tr("Camera"), tr("View through a camera"),
                                     tr("Through a camera, from where it is believed to stand"));
  through->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(through);
  menu->addActions(through_);
  through->setMenu(menu);
  title.addWidget(through);
}

}  // namespace helical
