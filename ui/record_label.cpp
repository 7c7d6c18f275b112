#include "ui/record_label.h"

#include <cmath>

#include "ui/format.h"
#include "ui/theme.h"

namespace helical {

RecordLabel::RecordLabel(QWidget* parent) : QLabel(parent) {
  setFont(theme::uiFont(8.4));
  setContentsMargins(10, 2, 10, 2);
  setAccessibleName(tr("Record of this flight"));
  setToolTip(
      tr("Everything but pictures is recorded from the start to the folder of sessions; Ctrl+R adds the "
         "cameras' pictures"));
}

void RecordLabel::showRecord(const RecordHealth& record, bool pictures) {
  QString text = tr("not recorded");
  QColor color = theme::kMuted;
  if (record.cut_off) {
    text = tr("\u25B2 the record is cut off");
    color = theme::kCaution;
  } else if (record.recording) {
    text = pictures ? tr("\u25CF recorded with pictures") : tr("\u25CF recorded");
    color = theme::kHealthy;
    if (pictures && std::isfinite(record.disk_free_gb))
      text += tr(", %1 GB left").arg(plainNumber(record.disk_free_gb, 0));
  }
  if (text != this->text()) setText(text);
  theme::setTextColor(*this, color);
}

}  // namespace helical
