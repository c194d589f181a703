#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/io/scene_object.hpp>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace graze::io {

/// Writes reports as JSON Lines (docs/formats.md): a header, then a line a frame. Every double is written so
/// that reading it back gives the same bits; the locale plays no part. For one thread at a time.
class GRAZE_API ReportWriter {
 public:
  struct Options {
    bool include_times = true;  ///< false: no timings, so that equal answers are equal files
  };

  /// Opens the file and writes the header. Throws InputError when it cannot be written.
  ReportWriter(const std::filesystem::path& path, std::span<const SceneObject> objects,
               const SceneSettings& settings, Options options);
  ReportWriter(const std::filesystem::path& path, std::span<const SceneObject> objects,
               const SceneSettings& settings)
      : ReportWriter(path, objects, settings, Options{}) {}
  ~ReportWriter();
  ReportWriter(ReportWriter&&) noexcept;
  ReportWriter& operator=(ReportWriter&&) noexcept;

  /// Appends one frame under the scene's number for it. Throws InputError when the disk takes no more.
  void write(std::uint64_t frame, const FrameReport& report);
  /// Ends the file; throws InputError when it did not all arrive. The destructor ends it too, silently.
  void close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// An edge's two vertices, the lower first; zeros beside a vertex or a face.
using EdgeVertices = std::array<std::uint32_t, 2>;

struct ReportedObject {
  std::uint32_t id = 0;
  std::string name;
  std::uint32_t vertices = 0;
  std::uint32_t faces = 0;
};

struct ReportedContact {
  Contact contact;
  EdgeVertices edge_a{};
  EdgeVertices edge_b{};
};

struct ReportedPair {
  std::uint32_t a = 0;  ///< an object's id in the header
  std::uint32_t b = 0;
  PairPhase phase = PairPhase::near;
  bool complete = true;
  bool contacts_cut = false;
  bool stale = false;
  DistanceBounds distance;
  Witness witness;
  EdgeVertices witness_edge_a{};
  EdgeVertices witness_edge_b{};
  std::vector<ReportedContact> contacts;
};

struct ReportedDiagnostic {
  std::optional<std::uint32_t> object;  ///< none for an id that names no object of the header
  DiagnosticKind kind = DiagnosticKind::stale_id;
  std::string message;
};

struct ReportedFrame {
  std::uint64_t frame = 0;
  bool complete = true;
  std::vector<ReportedPair> pairs;
  std::vector<ReportedDiagnostic> diagnostics;
  StepStatistics statistics;  ///< timings that were left out are 0
};

/// Reads such a file back, one frame at a time. For one thread at a time.
class GRAZE_API ReportReader {
 public:
  /// Opens the file and reads the header. Throws InputError for a file that cannot be read or is no report.
  explicit ReportReader(const std::filesystem::path& path);
  ~ReportReader();
  ReportReader(ReportReader&&) noexcept;
  ReportReader& operator=(ReportReader&&) noexcept;

  [[nodiscard]] std::span<const ReportedObject> objects() const;
  /// Those that a report keeps: distances, detail, accuracy, budgets.
  [[nodiscard]] const SceneSettings& settings() const;
  /// The next frame, or nothing at the end. Throws InputError, naming the line, for one that is no frame.
  std::optional<ReportedFrame> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace graze::io
