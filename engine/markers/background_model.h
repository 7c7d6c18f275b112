#pragma once

#include <cstdint>
#include <vector>

#include "engine/cameras/frame.h"
#include "engine/markers/background_ranges.h"

namespace helical {

/// The image of the empty field that markers are told from: the rounded mean of some frames, or one given
/// image, or none at all (colour alone). A frame of another size or format starts the averaging anew. `adapt`
/// follows light that changes slowly. Allocates when a size is first seen. One thread.
class BackgroundModel {
 public:
  enum class State { kTaking, kReady, kDisabled };

  explicit BackgroundModel(int frames) : frames_(frames) {}

  void take();
  void set(const ImageView& image);
  void disable() { state_ = State::kDisabled; }

  /// Feeds a frame; afterwards `state` says whether markers can be looked for in it.
  void update(const ImageView& image);

  /// Moves the next `rows` rows by one level towards the frame, outside of `left` to `right` in rows `top` to
  /// `bottom` (pixels, all inside), where the helicopter is. What differs by more than `most` is no change of
  /// light and stays as it is: a ball that was not found, standing still, never becomes background.
  struct KeptOut {
    int left = 0, top = 0, right = -1, bottom = -1;
  };
  void adapt(const ImageView& image, int rows, int most, const KeptOut& kept_out);

  State state() const { return state_; }
  /// Valid in state kReady; rows are packed.
  ImageView view() const;
  /// Of the same image.
  const BackgroundRanges& ranges() const { return ranges_; }

 private:
  void resize(const ImageView& image);
  bool fits(const ImageView& image) const;
  void accumulate(const ImageView& image);
  void average();
  void followRow(int y);

  int frames_;
  State state_ = State::kTaking;
  int taken_ = 0;
  int next_row_ = 0;
  int width_ = 0;
  int height_ = 0;
  PixelFormat format_ = PixelFormat::kBgr8;
  std::vector<std::uint32_t> sums_;
  std::vector<std::uint8_t> mean_;
  BackgroundRanges ranges_;
};

/// Bytes of a row's pixels.
int rowBytes(const ImageView& image);

}  // namespace helical
