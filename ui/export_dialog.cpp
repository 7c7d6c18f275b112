#include "ui/export_dialog.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/open_dialog.h"

namespace helical {
namespace {

constexpr int kBarSteps = 1000;

QCheckBox* box(QLayout& layout, const QString& text, bool checked) {
  auto* made = new QCheckBox(text);
  made->setChecked(checked);
  made->setAccessibleName(text);
  layout.addWidget(made);
  return made;
}

}  // namespace

ExportDialog::ExportDialog(const ExportContents& contents, QWidget* parent) : QDialog(parent), contents_(contents) {
  setWindowTitle(tr("Export %1").arg(QString::fromStdString(contents.session.filename().string())));
  setAccessibleName(windowTitle());
  setMinimumWidth(520);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(buildFormats());
  layout->addWidget(buildStreams(), 1);
  layout->addWidget(buildSpan());
  layout->addWidget(buildFolder());
  layout->addWidget(buildEnd());
  for (QCheckBox* one : {tables_, films_, scene_, png_, pdf_})
    connect(one, &QCheckBox::toggled, this, &ExportDialog::updateStart);
  connect(streams_, &QListWidget::itemChanged, this, &ExportDialog::updateStart);
  connect(folder_, &QLineEdit::textChanged, this, &ExportDialog::updateStart);
  connect(from_, &QDoubleSpinBox::valueChanged, this, &ExportDialog::updateStart);
  connect(to_, &QDoubleSpinBox::valueChanged, this, &ExportDialog::updateStart);
  setRunning(false);
}

QWidget* ExportDialog::buildFormats() {
  auto* group = new QGroupBox(tr("What"));
  auto* layout = new QVBoxLayout(group);
  tables_ = box(*layout, tr("Tables (CSV), one of each stream"), true);
  png_ = box(*layout, tr("Figures as pictures (PNG)"), true);
  pdf_ = box(*layout, tr("Figures and a report (PDF)"), true);
  films_ = box(*layout, tr("Films of the cameras with what was found in them (MP4)"), contents_.images);
  films_->setEnabled(contents_.images);
  if (!contents_.images) films_->setToolTip(tr("The session holds no images of the cameras"));
  scene_ = box(*layout, tr("Film of the 3D view (MP4)"), false);
  return group;
}

QWidget* ExportDialog::buildStreams() {
  auto* group = new QGroupBox(tr("Streams of the tables"));
  auto* layout = new QVBoxLayout(group);
  streams_ = new QListWidget;
  streams_->setAccessibleName(group->title());
  for (const auto& topic : contents_.topics) {
    auto* item = new QListWidgetItem(QString::fromStdString(topic), streams_);
    item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
    item->setCheckState(Qt::Checked);
  }
  layout->addWidget(streams_);
  auto* buttons = new QHBoxLayout;
  const auto add = [&](const QString& text, Qt::CheckState state) {
    auto* button = new QPushButton(text);
    buttons->addWidget(button);
    connect(button, &QPushButton::clicked, this, [this, state] {
      for (int i = 0; i < streams_->count(); ++i) streams_->item(i)->setCheckState(state);
    });
  };
  add(tr("All"), Qt::Checked);
  add(tr("None"), Qt::Unchecked);
  buttons->addStretch();
  layout->addLayout(buttons);
  return group;
}

QWidget* ExportDialog::buildSpan() {
  auto* group = new QGroupBox(tr("Time"));
  auto* layout = new QHBoxLayout(group);
  const auto add = [&](const QString& text, double value) {
    auto* spin = new QDoubleSpinBox;
    spin->setRange(0.0, std::ceil(1e2 * contents_.end_s) * 1e-2);
    spin->setDecimals(2);
    spin->setSuffix(QStringLiteral(" s"));
    spin->setValue(value);
    spin->setAccessibleName(text);
    layout->addWidget(new QLabel(text));
    layout->addWidget(spin);
    return spin;
  };
  from_ = add(tr("From"), std::floor(1e2 * contents_.begin_s) * 1e-2);
  to_ = add(tr("To"), std::ceil(1e2 * contents_.end_s) * 1e-2);
  layout->addStretch();
  return group;
}

QWidget* ExportDialog::buildFolder() {
  auto* group = new QGroupBox(tr("Folder"));
  auto* layout = new QHBoxLayout(group);
  std::filesystem::path folder = contents_.session;
  folder.replace_extension();
  folder_ = new QLineEdit(QString::fromStdString(folder.string() + "_export"));
  folder_->setAccessibleName(group->title());
  auto* choose = new QPushButton(tr("Choose..."));
  layout->addWidget(folder_, 1);
  layout->addWidget(choose);
  connect(choose, &QPushButton::clicked, this, [this] {
    auto* dialog = new QFileDialog(this, tr("Folder for the files"), folder_->text());
    dialog->setFileMode(QFileDialog::Directory);
    connect(dialog, &QFileDialog::fileSelected, folder_, &QLineEdit::setText);
    openDialog(dialog);
  });
  return group;
}

QWidget* ExportDialog::buildEnd() {
  auto* end = new QWidget;
  auto* layout = new QVBoxLayout(end);
  layout->setContentsMargins(0, 0, 0, 0);
  bar_ = new QProgressBar;
  bar_->setRange(0, kBarSteps);
  bar_->setAccessibleName(tr("Progress of the export"));
  state_ = new QLabel;
  state_->setWordWrap(true);
  state_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* buttons = new QHBoxLayout;
  start_ = new QPushButton(tr("Export"));
  cancel_ = new QPushButton(tr("Close"));
  start_->setDefault(true);
  buttons->addStretch();
  buttons->addWidget(start_);
  buttons->addWidget(cancel_);
  layout->addWidget(bar_);
  layout->addWidget(state_);
  layout->addLayout(buttons);
  connect(start_, &QPushButton::clicked, this, [this] {
    setRunning(true);
    Q_EMIT startRequested(order());
  });
  connect(cancel_, &QPushButton::clicked, this, [this] {
    if (running_)
      Q_EMIT cancelRequested();
    else
      reject();
  });
  return end;
}

ExportOrder ExportDialog::order() const {
  ExportOrder order;
  order.session = contents_.session;
  order.folder = folder_->text().toStdString();
  order.tables = tables_->isChecked();
  for (int i = 0; i < streams_->count(); ++i)
    if (streams_->item(i)->checkState() == Qt::Checked) order.topics.insert(streams_->item(i)->text().toStdString());
  order.films = films_->isChecked();
  order.scene = scene_->isChecked();
  order.png = png_->isChecked();
  order.pdf = pdf_->isChecked();
  order.span = {fromSeconds(from_->value()), fromSeconds(to_->value())};
  return order;
}

void ExportDialog::updateStart() {
  const ExportOrder wanted = order();
  const bool any = (wanted.tables && !wanted.topics.empty()) || wanted.films || wanted.scene || wanted.png || wanted.pdf;
  const bool tables_without_streams = wanted.tables && wanted.topics.empty();
  start_->setEnabled(!running_ && any && !tables_without_streams && !wanted.folder.empty() &&
                     wanted.span.from < wanted.span.to);
  streams_->setEnabled(!running_ && wanted.tables);
}

void ExportDialog::setRunning(bool running) {
  running_ = running;
  bar_->setVisible(running);
  bar_->setValue(0);
  cancel_->setText(running ? tr("Cancel") : tr("Close"));
  for (QWidget* one : std::initializer_list<QWidget*>{tables_, scene_, png_, pdf_, from_, to_, folder_})
    one->setEnabled(!running);
  films_->setEnabled(!running && contents_.images);
  if (running) state_->clear();
  updateStart();
}

void ExportDialog::showProgress(double done, const QString& step) {
  bar_->setValue(static_cast<int>(kBarSteps * std::clamp(done, 0.0, 1.0)));
  state_->setText(step);
}

void ExportDialog::showEnd(const QString& text) {
  setRunning(false);
  state_->setText(text);
}

void ExportDialog::reject() {
  if (running_) Q_EMIT cancelRequested();
  QDialog::reject();
}

}  // namespace helical
