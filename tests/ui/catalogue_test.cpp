#include "ui/catalogue.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QFile>
#include <QTemporaryDir>
#include <memory>

#include "engine/config/resource_files.h"

namespace helical {
namespace {

QString shippedFolder() {
  return QString::fromStdString((resourceFolder() / "translations").string());
}

/// Some translators want an application.
class CatalogueTest : public testing::Test {
 protected:
  void SetUp() override {
    static int argc = 1;
    static char name[] = "test_ui_values";
    static char* argv[] = {name, nullptr};
    if (QCoreApplication::instance() == nullptr)
      application_ = std::make_unique<QCoreApplication>(argc, argv);
  }
  std::unique_ptr<QCoreApplication> application_;
};

TEST_F(CatalogueTest, GermanIsThereForGermanSpeakersOnly) {
  Catalogue catalogue;
  EXPECT_TRUE(catalogue.loadFor({"de-AT", "de", "en"}, shippedFolder()));
  EXPECT_EQ(catalogue.translate("any", "Take off"), "Starten");
  EXPECT_TRUE(catalogue.translate("any", "no such text").isNull());
  EXPECT_FALSE(Catalogue().loadFor({"en-US", "de"}, shippedFolder()));
  EXPECT_FALSE(Catalogue().loadFor({"xx"}, shippedFolder()));
  EXPECT_TRUE(Catalogue().loadFor({"xx", "de"}, shippedFolder()));
}

TEST_F(CatalogueTest, ABrokenFileIsNone) {
  const QTemporaryDir folder;
  QFile file(folder.filePath("helical_de.ts"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("<TS><context><message><source>a</source><translation>b</transl");
  file.close();
  Catalogue catalogue;
  EXPECT_FALSE(catalogue.loadFor({"de"}, folder.path()));
  EXPECT_TRUE(catalogue.isEmpty());
}

TEST_F(CatalogueTest, TheEnginesWordsAreTranslatedAndNamesKept) {
  EXPECT_EQ(engineText("Camera 2: hidden by the operator"), "Camera 2: hidden by the operator") << "English";
  Catalogue catalogue;
  ASSERT_TRUE(catalogue.loadFor({"de"}, shippedFolder()));
  QCoreApplication::installTranslator(&catalogue);
  EXPECT_EQ(engineText("Airborne"), "In der Luft");
  EXPECT_EQ(engineText("Camera 2: hidden by the operator"), "Camera 2: vom Bediener ausgeblendet");
  EXPECT_EQ(engineText("Take-off refused: it moves"), "Start verweigert: er bewegt sich");
  EXPECT_EQ(engineText("No pose for 0.5 s: open-loop descent"), "Seit 0,5 s keine Lage: blinder Sinkflug");
  EXPECT_EQ(engineText("Camera 3: calibrates anew by ekf"), "Camera 3: kalibriert neu mit ekf");
  EXPECT_EQ(engineText("Camera 3: something new"), "Camera 3: something new");
  QCoreApplication::removeTranslator(&catalogue);
}

}  // namespace
}  // namespace helical
