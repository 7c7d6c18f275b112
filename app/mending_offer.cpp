#include "app/mending_offer.h"

#include <string>

#include "engine/base/log.h"
#include "engine/session/mcap_recovery.h"

namespace helical {
namespace {

void mendOne(const std::filesystem::path& file) {
  try {
    const Recovery recovery = recoverMcap(file);
    log(LogLevel::kInfo,
        file.string() + " is mended: " + std::to_string(recovery.messages) + " messages saved");
  } catch (const std::exception& error) {
    log(LogLevel::kWarning, error.what());
  }
}

}  // namespace

MendingOffer::MendingOffer(QWidget& window, std::vector<std::filesystem::path> cut_off)
    : cut_off_(std::move(cut_off)) {
  if (cut_off_.empty()) return;
  box_ = new QMessageBox(QMessageBox::Question, QObject::tr("Mend the last record"),
                         QObject::tr("%n recorded session(s) were cut off, the last one is\n%1", "",
                                     static_cast<int>(cut_off_.size()))
                             .arg(QString::fromStdString(cut_off_.front().string())),
                         QMessageBox::NoButton, &window);
  box_->addButton(QObject::tr("Mend now"), QMessageBox::AcceptRole);
  box_->addButton(QObject::tr("Later"), QMessageBox::RejectRole);
  box_->setAttribute(Qt::WA_DeleteOnClose);
  box_->setWindowModality(Qt::NonModal);
  QObject::connect(box_, &QMessageBox::accepted, [this] { mend(); });
  box_->show();
}

MendingOffer::~MendingOffer() {
  delete box_;
}

void MendingOffer::mend() {
  thread_ = std::jthread([files = cut_off_](const std::stop_token& stop) {
    for (const auto& file : files) {
      if (stop.stop_requested()) return;
      mendOne(file);
    }
  });
}

}  // namespace helical
