#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/markers/binary_mask.h"
#include "engine/markers/cell_grid.h"

namespace helical {

/// Corners of an area of an image in pixels, in order along its border, which closes by itself. Where it
/// crosses itself, what lies inside is counted by the even-odd rule.
using Polygon = std::vector<Eigen::Vector2d>;

/// Parts of a camera's image that never show the helicopter, but things of its markers' colour: nothing is
/// looked for there. They may overlap and reach beyond the image.
using IgnoredAreas = std::vector<Polygon>;

bool contains(const Polygon& polygon, const Eigen::Vector2d& pixel);
bool isIgnored(const IgnoredAreas& areas, const Eigen::Vector2d& pixel);

/// Sets `mask`, resized to the grid, to the cells whose centres lie in the areas.
void fillMask(const IgnoredAreas& areas, const CellGrid& grid, BinaryMask& mask);

}  // namespace helical
