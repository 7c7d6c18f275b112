#include <gtest/gtest.h>

#include <QApplication>
#include <memory>

#include "ui/theme.h"

namespace {

/// Qt wants one application object for the whole process, before the first widget.
class Application : public testing::Environment {
 public:
  void SetUp() override {
#ifdef HELICAL_TEST_SCALE
    qputenv("QT_SCALE_FACTOR", HELICAL_TEST_SCALE);
#endif
    static int argc = 1;
    static char name[] = "test_ui_window";
    static char* argv[] = {name, nullptr};
    application_ = std::make_unique<QApplication>(argc, argv);
    helical::theme::apply(*application_);
  }
  void TearDown() override { application_.reset(); }

 private:
  std::unique_ptr<QApplication> application_;
};

const auto* const kApplication = testing::AddGlobalTestEnvironment(new Application);

}  // namespace
