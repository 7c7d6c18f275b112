#pragma once

#include <QMessageBox>
#include <QPointer>
#include <QWidget>
#include <filesystem>
#include <thread>
#include <vector>

namespace helical {

/// Asks, without being in anybody's way, whether records that were cut off shall be mended, and does it on a
/// thread of its own; what became of it is logged. Nothing happens without any. The window's thread.
class MendingOffer {
 public:
  MendingOffer(QWidget& window, std::vector<std::filesystem::path> cut_off);
  ~MendingOffer();  ///< waits until the file at hand is mended
  MendingOffer(const MendingOffer&) = delete;
  MendingOffer& operator=(const MendingOffer&) = delete;

 private:
  void mend();

  std::vector<std::filesystem::path> cut_off_;
  QPointer<QMessageBox> box_;
  std::jthread thread_;
};

}  // namespace helical
