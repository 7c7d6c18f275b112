#pragma once

#include <filesystem>
#include <vector>

#include "engine/experiments/flight_trace.h"
#include "ui/figures/figure.h"

namespace helical {

/// Writes figures 6 to 11 of Matsukawa, Arai and Hashimoto (SII 2010) for a flight of experiment A and one of
/// experiment B into `folder`, which is made if need be: fig06.png, fig06.pdf, ... fig11.pdf, whose names are
/// returned. Throws `Error` with the file and a cure if one cannot be written. Works without a display; the
/// main thread, or the window's if there is one.
std::vector<std::filesystem::path> writePaperFigures(const FlightTrace& experiment_a,
                                                     const FlightTrace& experiment_b,
                                                     const std::filesystem::path& folder);

namespace figures {

/// What these six show, with the paper's axes: time from 0 to 25 s; 6: x and y from -0.8 to 0.2 m; 7: z from
/// 0 to 0.8 m and yaw from -0.4 to 0.4 rad; 8 and 11: the selected image features of A and of B by their
/// labels, markers (i - 1) + j - 1; 9 and 10: the error of the learning camera's position from -0.8 to 0.8 m
/// and of its orientation from -40 to 40 degrees, three components each. Pure.
std::vector<Figure> paperFigures(const FlightTrace& experiment_a, const FlightTrace& experiment_b);

}  // namespace figures
}  // namespace helical
