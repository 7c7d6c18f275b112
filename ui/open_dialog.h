#pragma once

#include <QString>
#include <QStringList>
#include <functional>

class QDialog;
class QWidget;

namespace helical {

/// Dialogs that leave the window usable: a modal one would keep STOP from the mouse. All return at once and
/// delete themselves when closed.

/// Shows it without blocking anything.
void openDialog(QDialog* dialog);
void openNotice(QWidget* parent, const QString& title, const QString& text);
/// `then` gets the path unless the user thinks better of it. `filter` as QFileDialog has it, "*.png".
void askWhereToSave(QWidget* parent, const QString& title, const QString& name, const QString& filter,
                    const std::function<void(const QString&)>& then);
void askWhatToOpen(QWidget* parent, const QString& title, const QString& folder, const QString& filter,
                   const std::function<void(const QString&)>& then);
/// The same for several files.
void askWhichToOpen(QWidget* parent, const QString& title, const QString& folder, const QString& filter,
                    const std::function<void(const QStringList&)>& then);

}  // namespace helical
