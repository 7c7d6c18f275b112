#pragma once

#include <QList>
#include <QObject>

#include "engine/config/rig_config.h"

class QAction;
class QActionGroup;

namespace helical {

class PanelTitle;
class SceneView;

/// From where the 3D scene is looked at, as actions for the menu and as buttons in the scene's title.
class Viewpoints : public QObject {
  Q_OBJECT

 public:
  Viewpoints(const RigConfig& rig, SceneView& scene, QObject* parent);

  QList<QAction*> actions() const;
  void addButtons(PanelTitle& title) const;
  /// All of the field, from the side.
  void lookFromTheSide();

 private:
  SceneView& scene_;
  QActionGroup* group_;
  QList<QAction*> standing_;  ///< in the order of SceneViewpoint
  QList<QAction*> through_;   ///< one a camera
};

}  // namespace helical
