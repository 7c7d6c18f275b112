#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/session/export_selection.h"

namespace helical {

struct VideoExport {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> without_images;  ///< labels of cameras that the session has no images of
};

/// Writes an MP4 film of each camera whose images a session holds, at 30 pictures a second of the flight's
/// time, with what was found in them drawn on top: centroids, the markers' names, where they were expected,
/// time and phase. Files are `camera_LABEL.mp4` in `folder`, which is made if need be. Throws Error for a
/// session that cannot be read and a folder or film that cannot be written.
VideoExport exportVideo(const std::filesystem::path& session, const std::filesystem::path& folder,
                        const ExportProgress& progress, const ExportSpan& span = {});

}  // namespace helical
