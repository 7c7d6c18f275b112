#pragma once

#include <QHash>
#include <QLocale>
#include <QStringList>
#include <QTranslator>

namespace helical {

/// The window's texts in another language, straight from a Qt Linguist file (.ts): nothing has to be
/// compiled, and a missing text stays English. Sources are unique over all contexts.
class Catalogue : public QTranslator {
  Q_OBJECT

 public:
  using QTranslator::QTranslator;

  /// False if the file cannot be read or holds nothing.
  bool loadFile(const QString& file);
  /// The first of the languages for which `folder` has a file helical_LANGUAGE.ts; English needs none.
  bool loadFor(const QStringList& languages, const QString& folder);

  QString translate(const char* context, const char* source, const char* disambiguation = nullptr,
                    int n = -1) const override;
  bool isEmpty() const override { return texts_.isEmpty(); }
  const QHash<QString, QString>& texts() const { return texts_; }

 private:
  QHash<QString, QString> texts_;
};

/// What the engine says, in the window's language. The engine itself speaks English: its words are also in
/// logs and sessions. A camera's name before a colon stays as it is.
QString engineText(const QString& english);

}  // namespace helical
