#include "engine/geometry/quiet_ceres.h"

#include <gtest/gtest.h>

#if __has_include(<glog/logging.h>)
#include <glog/logging.h>

namespace helical {
namespace {

TEST(QuietCeres, WarningsStayFromStderr) {
  quietCeres();
  testing::internal::CaptureStderr();
  LOG(WARNING) << "Linear solver failure.";
  LOG(ERROR) << "an error";
  const std::string seen = testing::internal::GetCapturedStderr();
  EXPECT_EQ(seen.find("Linear solver failure"), std::string::npos) << seen;
  EXPECT_NE(seen.find("an error"), std::string::npos) << seen;
}

}  // namespace
}  // namespace helical
#endif
