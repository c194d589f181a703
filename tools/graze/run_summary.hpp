#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/io/scene_object.hpp>
#include <graze/report.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace graze::tools {

/// Collects what a run saw, and says it.
class RunSummary {
 public:
  explicit RunSummary(std::span<const io::SceneObject> objects);

  void add(std::uint32_t frame, const FrameReport& report, double step_ms);
  /// The summary, several lines.
  [[nodiscard]] std::string text() const;

 private:
  /// The smallest separation of contacts so far, and its frame.
  struct Deepest {
    double separation = 0;
    std::uint32_t frame = 0;
  };
  /// One pair of objects that touched.
  struct Touch {
    std::uint32_t first_frame = 0;
    std::uint32_t last_frame = 0;
    std::uint32_t frames = 0;
    std::uint32_t spells = 0;                ///< times that they came together
    std::array<std::uint32_t, 4> insides{};  ///< frames, by Inside
    std::size_t most_contacts = 0;
    std::optional<Deepest> deepest;  ///< none where no contact was listed
    Eigen::Vector3d first_place = Eigen::Vector3d::Zero();
  };

  void add_touch(std::uint32_t frame, const PairReport& pair, std::span<const Contact> contacts);
  [[nodiscard]] std::string name_of(std::size_t number) const;
  [[nodiscard]] std::string names_of(std::size_t a, std::size_t b) const;
  [[nodiscard]] std::string inside_text(std::size_t a, std::size_t b, const Touch& touch) const;
  [[nodiscard]] static std::string deepest_text(const Touch& touch);
  [[nodiscard]] std::string limits_text() const;
  [[nodiscard]] std::string touches_text() const;
  [[nodiscard]] std::string diagnostics_text() const;
  [[nodiscard]] std::string times_text() const;

  std::span<const io::SceneObject> objects_;
  std::map<ObjectId, std::size_t> numbers_;
  std::map<std::pair<std::size_t, std::size_t>, Touch> touches_;
  std::vector<double> step_ms_;
  std::uint64_t pairs_ = 0;
  std::size_t contacts_ = 0;
  std::size_t contacts_left_out_ = 0;
  std::size_t frames_cut_ = 0;
  std::size_t most_contacts_ = 0;
  std::uint32_t busiest_frame_ = 0;
  std::uint32_t frames_touching_ = 0;
  std::size_t diagnostics_ = 0;
  std::string first_diagnostic_;
};

}  // namespace graze::tools
