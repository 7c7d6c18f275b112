#include "ui/heat_maps.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QPixmap>
#include <QTemporaryDir>

namespace helical {
namespace {

TEST(HeatMaps, AreSavedAsPicturePageAndTable) {
  HeatMaps maps("Camera 2", {640, 480});
  maps.resize(260, 110);
  CameraTrack track;
  track.exposure = 1;
  track.markers[0].observed = track.markers[0].selected = track.markers[0].predicted = true;
  track.markers[0].pixel = {5.0, 7.0};
  track.markers[0].reprojected = {5.0, 7.5};
  maps.add(track, 1);
  QTemporaryDir folder;
  for (const char* name : {"a.png", "a.pdf", "a.csv"}) EXPECT_TRUE(maps.save(folder.filePath(name))) << name;
  EXPECT_GE(QPixmap(folder.filePath("a.png")).width(), 260);
  QFile table(folder.filePath("a.csv"));
  ASSERT_TRUE(table.open(QIODevice::ReadOnly | QIODevice::Text));
  const QList<QByteArray> lines = table.readAll().trimmed().split('\n');
  ASSERT_EQ(lines.size(), 1 + ImageHeat::kColumns * ImageHeat::kRows);
  EXPECT_EQ(lines[0].toStdString(), "u_px,v_px,markers,residual_px");
  EXPECT_EQ(lines[1].toStdString(), "19.5,19.5,1,0.5");
  EXPECT_EQ(lines[2].toStdString(), "59.5,19.5,0,");
  EXPECT_FALSE(maps.save("/proc/nowhere/a.csv"));
}

}  // namespace
}  // namespace helical
