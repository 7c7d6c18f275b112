#include "ui/scene_film.h"

#include <QImage>
#include <QPainter>
#include <QTimer>
#include <algorithm>

#include "engine/base/error.h"
#include "engine/session/film_writer.h"
#include "engine/session/flight_playback.h"
#include "ui/orbit_view.h"
#include "ui/scene_extent.h"
#include "ui/scene_frame_builder.h"
#include "ui/scene_labels.h"
#include "ui/scene_thread.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr QSize kPicture(960, 540);

}  // namespace

SceneFilm::SceneFilm(const ExportOrder& order)
    : file_(order.folder / "scene.mp4"),
      playback_(std::make_unique<FlightPlayback>(order.session, std::make_shared<ManualClock>())),
      setup_(sceneSetup(playback_->rig())),
      builder_(std::make_unique<SceneFrameBuilder>(playback_->rig())),
      orbit_(std::make_unique<OrbitView>()),
      renderer_(std::make_unique<SceneThread>(setup_)),
      writer_(std::make_unique<FilmWriter>(file_)),
      begin_(std::max(playback_->begin(), order.span.from)),
      end_(std::min(playback_->end(), order.span.to)),
      now_(begin_) {
  std::error_code failure;
  std::filesystem::create_directories(order.folder, failure);
  if (failure)
    throw Error(ErrorKind::kInput, "the folder for the export cannot be made: " + failure.message(),
                order.folder.string(), "choose a folder that can be written to");
  orbit_->look(SceneViewpoint::kIso);
  builder_->setPlan(playback_->plan(), false);
  connect(renderer_.get(), &SceneThread::rendered, this, &SceneFilm::add);
}

SceneFilm::~SceneFilm() = default;

void SceneFilm::start() {
  QTimer::singleShot(0, this, &SceneFilm::step);
}

void SceneFilm::step() {
  if (ended_) return;
  if (now_ > end_) {
    const bool any = writer_->begun();
    writer_->finish();
    return end(any ? QString() : tr("the session holds no picture in this span"));
  }
  playback_->seek(now_);
  EngineSnapshot tick;
  while (playback_->nextTick(tick)) builder_->addTick(tick);
  for (std::size_t i = 0; i < playback_->rig().cameras.size(); ++i) {
    const CameraId camera = cameraId(static_cast<int>(i));
    if (playback_->pollCalibration(camera))
      builder_->setCalibration(camera.index(), playback_->calibration(camera));
  }
  SceneFrame frame = builder_->build(playback_->snapshot());
  if (const std::uint32_t known = knownCameras(frame); known != seen_cameras_) {
    seen_cameras_ = known;
    orbit_->setField(sceneExtent(setup_, frame), static_cast<double>(kPicture.width()) / kPicture.height());
  }
  orbit_->track(frame.world_from_body.translation);
  frame.eye = orbit_->eye();
  frame.focus = orbit_->focus();
  frame.up = orbit_->up();
  if (!renderer_->request(frame, kPicture, 1.0)) end(tr("the 3D view needs OpenGL 3.2"));
}

void SceneFilm::add(const RenderedScene& scene) {
  if (ended_) return;
  if (scene.image.isNull()) return end(tr("the 3D view needs OpenGL 3.2"));
  QImage picture = scene.image;
  paintWords(picture, scene);
  picture = picture.convertToFormat(QImage::Format_BGR888);
  try {
    writer_->add(picture.constBits(), picture.width(), picture.height(),
                 static_cast<std::size_t>(picture.bytesPerLine()));
  } catch (const Error& error) {
    return end(QString::fromUtf8(error.what()));
  }
  Q_EMIT progressed(static_cast<double>(now_ - begin_) /
                    static_cast<double>(std::max<TimeNs>(1, end_ - begin_)));
  now_ += fromSeconds(1.0 / FilmWriter::kPicturesPerSecond);
  QTimer::singleShot(0, this, &SceneFilm::step);
}

void SceneFilm::paintWords(QImage& picture, const RenderedScene& scene) const {
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::TextAntialiasing);
  paintSceneLabels(painter, scene.labels, playback_->rig());
  painter.setPen(theme::on_dark::kText);
  painter.setFont(theme::monoFont(9.0));
  painter.drawText(QPointF(14.0, kPicture.height() - 14.0),
                   QStringLiteral("%1 s   %2")
                       .arg(toSeconds(now_), 0, 'f', 2)
                       .arg(QString::fromLatin1(toString(playback_->snapshot().phase))));
}

void SceneFilm::end(const QString& failure) {
  if (ended_) return;
  ended_ = true;
  Q_EMIT finished(failure);
}

}  // namespace helical
