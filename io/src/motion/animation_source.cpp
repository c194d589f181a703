#include <algorithm>
#include <cmath>
#include <graze/error.hpp>
#include <graze/io/motion.hpp>
#include <limits>
#include <string>
#include <utility>

#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

/// The last frame is the first one at or behind the end, where the animation is clamped.
std::uint32_t frames_of(double seconds, double frames_per_second) {
  constexpr double rounding = 1e-6;  // 20 frames of 1/24 s are 20 frames, whatever their sum
  const double last = std::ceil(seconds * frames_per_second - rounding);
  constexpr auto most = static_cast<double>(std::numeric_limits<std::uint32_t>::max() - 1);
  return static_cast<std::uint32_t>(std::clamp(last, 0.0, most)) + 1;
}

class AnimationSource : public PositionSource {
 public:
  AnimationSource(MeshFile file, std::size_t object, std::size_t animation, double frames_per_second)
      : file_(std::move(file)),
        object_(object),
        animation_(animation),
        frames_per_second_(frames_per_second),
        frame_count_(frames_of(file_.animation_seconds(animation), frames_per_second)) {}

  [[nodiscard]] std::uint32_t frame_count() const override { return frame_count_; }

  void read(std::uint32_t frame, std::vector<Eigen::Vector3d>& positions) override {
    file_.animate(object_, animation_, static_cast<double>(frame) / frames_per_second_, positions);
  }

 private:
  MeshFile file_;
  std::size_t object_;
  std::size_t animation_;
  double frames_per_second_;
  std::uint32_t frame_count_;
};

}  // namespace

PositionSource::~PositionSource() = default;

std::span<const std::string> PositionSource::warnings() const {
  return {};
}

std::unique_ptr<PositionSource> open_animation(const MeshFile& file, std::size_t object,
                                               std::size_t animation, double frames_per_second) {
  if (!(frames_per_second > 0) || !std::isfinite(frames_per_second))
    throw Error("animation: frames_per_second must be a positive number");
  if (object >= file.objects().size())
    throw Error(joined("animation: object ", object, " of ", file.objects().size(), " does not exist"));
  return std::make_unique<AnimationSource>(file, object, animation, frames_per_second);
}

}  // namespace graze::io
