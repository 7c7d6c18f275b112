#include "ui/catalogue.h"

#include <QCoreApplication>
#include <QFile>
#include <QXmlStreamReader>

namespace helical {
namespace {

QString translated(const QString& english) {
  return QCoreApplication::translate("engine", english.toUtf8().constData());
}

}  // namespace

bool Catalogue::loadFile(const QString& file) {
  texts_.clear();
  QFile source(file);
  if (!source.open(QIODevice::ReadOnly)) return false;
  QXmlStreamReader xml(&source);
  QString english;
  while (!xml.atEnd()) {
    xml.readNext();
    if (!xml.isStartElement()) continue;
    if (xml.name() == QLatin1String("source")) english = xml.readElementText();
    if (xml.name() != QLatin1String("translation")) continue;
    const QString text = xml.readElementText();
    if (!english.isEmpty() && !text.isEmpty()) texts_.insert(english, text);
  }
  if (xml.hasError()) texts_.clear();
  return !texts_.isEmpty();
}

bool Catalogue::loadFor(const QStringList& languages, const QString& folder) {
  for (const QString& language : languages) {
    const QString code = language.section(QLatin1Char('-'), 0, 0).section(QLatin1Char('_'), 0, 0).toLower();
    if (code == QLatin1String("en") || code == QLatin1String("c")) return false;
    if (loadFile(QStringLiteral("%1/helical_%2.ts").arg(folder, code))) return true;
  }
  return false;
}

QString Catalogue::translate(const char*, const char* source, const char*, int) const {
  return texts_.value(QString::fromUtf8(source));
}

QString engineText(const QString& english) {
  const QString whole = translated(english);
  const auto colon = english.indexOf(QLatin1String(": "));
  if (whole != english || colon < 0) return whole;
  const QString rest = english.mid(colon + 2), head = english.left(colon + 2);
  static const QString kBy = QStringLiteral("calibrates anew by ");
  if (rest.startsWith(kBy))
    return head + translated(QStringLiteral("calibrates anew by ")) + rest.mid(kBy.size());
  // "Take-off refused: it moves" has words of ours on both sides, "Camera 2: hidden" on one, and
  // "Camera 2: order refused: it does not learn" on both of the rest.
  return translated(head.trimmed()) + QLatin1Char(' ') + engineText(rest);
}

}  // namespace helical
