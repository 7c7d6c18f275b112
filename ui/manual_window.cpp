#include "ui/manual_window.h"

#include <QFile>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "ui/theme.h"

namespace helical {

ManualWindow::ManualWindow(const QString& file, QWidget* parent)
    : QDialog(parent), text_(new QTextBrowser) {
  setWindowTitle(tr("Manual"));
  setAccessibleName(windowTitle());
  resize(860, 720);
  text_->setAccessibleName(tr("Text of the manual"));
  text_->setToolTip(tr("Arrow keys and Page up, Page down scroll"));
  text_->setFrameShape(QFrame::NoFrame);
  text_->setFont(theme::uiFont(10));
  text_->setOpenExternalLinks(true);
  text_->document()->setDocumentMargin(24);
  QFile source(file);
  if (source.open(QIODevice::ReadOnly))
    text_->setMarkdown(QString::fromUtf8(source.readAll()));
  else
    text_->setPlainText(tr("The manual is missing: %1").arg(file));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(text_);
}

}  // namespace helical
