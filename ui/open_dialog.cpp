#include "ui/open_dialog.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>

namespace helical {

void openDialog(QDialog* dialog) {
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowModality(Qt::NonModal);
  dialog->show();
  dialog->raise();
}

void openNotice(QWidget* parent, const QString& title, const QString& text) {
  auto* box = new QMessageBox(QMessageBox::NoIcon, title, text, QMessageBox::Ok, parent);
  openDialog(box);
}

void askWhereToSave(QWidget* parent, const QString& title, const QString& name, const QString& filter,
                    const std::function<void(const QString&)>& then) {
  auto* dialog = new QFileDialog(parent, title, QDir::currentPath(), filter);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QFileInfo(name).suffix());
  dialog->selectFile(name);
  QObject::connect(dialog, &QFileDialog::fileSelected, parent, then);
  openDialog(dialog);
}

void askWhatToOpen(QWidget* parent, const QString& title, const QString& folder, const QString& filter,
                   const std::function<void(const QString&)>& then) {
  auto* dialog = new QFileDialog(parent, title, folder, filter);
  dialog->setFileMode(QFileDialog::ExistingFile);
  QObject::connect(dialog, &QFileDialog::fileSelected, parent, then);
  openDialog(dialog);
}

void askWhichToOpen(QWidget* parent, const QString& title, const QString& folder, const QString& filter,
                    const std::function<void(const QStringList&)>& then) {
  auto* dialog = new QFileDialog(parent, title, folder, filter);
  dialog->setFileMode(QFileDialog::ExistingFiles);
  QObject::connect(dialog, &QFileDialog::filesSelected, parent, then);
  openDialog(dialog);
}

}  // namespace helical
