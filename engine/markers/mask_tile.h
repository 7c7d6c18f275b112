#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/markers/binary_mask.h"
#include "engine/markers/mask_kernels.h"

namespace helical {

/// A rectangle of a mask, copied out of it for opening and closing: column after column of 64-cell words, so
/// that vectors hold rows and a small rectangle takes a few cache lines. As in OpenCV, cells outside of the
/// image never decide: they count as set for an erosion, as unset for a dilation. Cells of the image outside
/// of the rectangle count as unset. Allocates in `resize` only. One thread.
class MaskTile {
 public:
  MaskTile() = default;
  MaskTile(const MaskTile&) = delete;  // it points into itself
  MaskTile& operator=(const MaskTile&) = delete;

  /// Of the image, in cells.
  void resize(int width, int height);
  /// Becomes this rectangle, which lies inside of the image; its words are the caller's to fill.
  void place(const WordRect& rect);

  const WordRect& rect() const { return rect_; }
  int rows() const { return rect_.bottom - rect_.top + 1; }
  int columns() const { return rect_.right - rect_.left + 1; }
  /// Words from a column to the next.
  std::ptrdiff_t stride() const { return stride_; }
  /// The words of a column of the image, from the rectangle's first row on.
  std::uint64_t* column(int word) { return now_->data() + kPadding + (word - rect_.left) * stride_; }
  const std::uint64_t* column(int word) const {
    return now_->data() + kPadding + (word - rect_.left) * stride_;
  }

  /// With a square of side 2 `reach` + 1, `reach` at most 7.
  void open(int reach);
  void close(int reach);
  /// Both; quick where most rows are set from end to end, which stay so.
  void openAndCloseFull(int opening, int closing);
  /// For each row: 0 where it is like the row above. Valid until the next call of another function.
  std::span<const std::uint64_t> changes();

 private:
  static constexpr int kPadding =
      8;  ///< words above and below a column, for vectors that reach over its ends

  void erode(int reach);
  void dilate(int reach);
  void pad(int reach, std::uint64_t above, std::uint64_t below);
  void advance(bool erode, int reach);
  MaskStep step() const;
  bool isAtRight() const { return rect_.right == image_words_ - 1; }

  int image_words_ = 0;
  int image_height_ = 0;
  std::uint64_t outside_ = 0;  ///< cells of a row's last word that lie outside of the image
  WordRect rect_;
  /// Of the rectangle's rows, those that are worked on; the others are full.
  int first_row_ = 0;
  int end_row_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint64_t> a_, b_;
  std::vector<std::uint64_t> by_row_;
  std::vector<std::uint64_t>* now_ = &a_;
  std::vector<std::uint64_t>* next_ = &b_;
};

}  // namespace helical
