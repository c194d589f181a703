#include "bench/scenes/slow_motion.hpp"

#include <utility>

namespace graze::bench {
namespace {

Body slowed(Body body, std::size_t times) {
  body.place = [place = std::move(body.place), times](std::size_t frame, std::span<float> out) {
    std::vector<float> next(out.size());
    // A body that does not change in the next frame is treated as at rest.
    if (!place(frame / times + 1, next)) return frame == 0 && place(0, out);
    place(frame / times, out);
    const float share = static_cast<float>(frame % times) / static_cast<float>(times);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += share * (next[i] - out[i]);
    return true;
  };
  return body;
}

}  // namespace

BenchScene in_slow_motion(BenchScene scene, std::size_t times) {
  if (times == 1) return scene;
  scene.what += ", " + std::to_string(times) + " times slower";
  scene.frames *= times;
  for (Body& body : scene.bodies) body = slowed(std::move(body), times);
  return scene;
}

}  // namespace graze::bench
