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

/// @addtogroup io_reports
/// @{

/// Writes reports as JSON Lines: a header, then a line for each frame. docs/formats.md describes the format.
/// Every double is written so that reading it back gives the same bits. The locale plays no part. One thread
/// at a time may use a writer.
class GRAZE_API ReportWriter {
 public:
  /// Says what a writer leaves out.
  struct Options {
    /// False leaves out all timings, and StepBytes::threads. Equal answers are then equal files.
    bool include_times = true;
    /// False leaves out the contacts. Each pair then has their number alone, ReportedPair::contact_count.
    bool include_contacts = true;
    /// Writes the first frame and each `every`-th one after it. At least 1.
    std::uint64_t every = 1;
  };

  /// Opens the file and writes the header. `objects` are all objects of the scene, in the order in which they
  /// were added. A file of that name is written over. It is compressed as gzip does it if its name ends in
  /// `.gz`. Throws InputError if the file cannot be written, and Error if Options::every is 0.
  ReportWriter(const std::filesystem::path& path, std::span<const SceneObject> objects,
               const SceneSettings& settings, Options options);
  /// Opens the file and writes the header, with default options.
  ReportWriter(const std::filesystem::path& path, std::span<const SceneObject> objects,
               const SceneSettings& settings)
      : ReportWriter(path, objects, settings, Options{}) {}
  /// Ends the file without saying whether all of it arrived. Call close() to know.
  ~ReportWriter();
  /// Takes the file of the other writer, which may then only be destroyed or assigned to.
  ReportWriter(ReportWriter&&) noexcept;
  /// Ends the file of this writer and takes that of the other one, which may then only be destroyed or
  /// assigned to.
  ReportWriter& operator=(ReportWriter&&) noexcept;

  /// Appends a report under the number `frame`, which is the caller's, unless Options::every skips it. Throws
  /// InputError if the disk takes no more, or if the report has an object that the header has not.
  void write(std::uint64_t frame, const FrameReport& report);
  /// Ends the file. Throws InputError if not all of it arrived on the disk.
  void close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The two vertices of an edge, the lower one first. Both are 0 if the feature is a vertex or a face.
using EdgeVertices = std::array<std::uint32_t, 2>;

/// An object in the header of a report file.
struct ReportedObject {
  /// The index of the object in the header. Pairs and diagnostics name objects by it.
  std::uint32_t id = 0;
  /// The name of the object.
  std::string name;
  /// The number of vertices of its mesh.
  std::uint32_t vertices = 0;
  /// The number of faces of its mesh.
  std::uint32_t faces = 0;
};

/// A contact in a report file.
struct ReportedContact {
  /// The contact. An index of an edge is that of the mesh that the writer had. Contact::since counts in the
  /// numbers of the file, as ReportedFrame::frame does.
  Contact contact;
  /// The vertices of feature a, if it is an edge.
  EdgeVertices edge_a{};
  /// The vertices of feature b, if it is an edge.
  EdgeVertices edge_b{};
};

/// What met on the way, in a report file.
struct ReportedImpact {
  /// The impact.
  Impact impact;
  /// The vertices of feature a, if it is an edge.
  EdgeVertices edge_a{};
  /// The vertices of feature b, if it is an edge.
  EdgeVertices edge_b{};
};

/// A row in a report file. Its members mean what those of PairReport mean.
struct ReportedPair {
  /// The object that was added first, by its ReportedObject::id.
  std::uint32_t a = 0;
  /// The object that was added last, by its ReportedObject::id.
  std::uint32_t b = 0;
  /// Whether the pair is in contact, and whether it was in the report before.
  PairPhase phase = PairPhase::near;
  /// False if a budget ran out, or if #contacts_cut is true.
  bool complete = true;
  /// True if a limit left contacts out.
  bool contacts_cut = false;
  /// True if the positions or the pose of one of the objects were not taken.
  bool stale = false;
  /// Whether one object is inside the other, if one of them is a solid.
  Inside inside = Inside::none;
  /// The bounds of the distance.
  DistanceBounds distance;
  /// The two points that are DistanceBounds::upper apart.
  Witness witness;
  /// The vertices of feature a of the witness, if it is an edge.
  EdgeVertices witness_edge_a{};
  /// The vertices of feature b of the witness, if it is an edge.
  EdgeVertices witness_edge_b{};
  /// How b leaves a. All of it is 0 if the file says nothing of it.
  WayOut way_out;
  /// The contacts of the pair, sorted by kind, feature a, feature b. Empty if the report has no contacts, see
  /// ReportReader::has_contacts().
  std::vector<ReportedContact> contacts;
  /// The number of contacts of the pair, also if the report leaves them out.
  std::uint64_t contact_count = 0;
  /// PairReport::time_of_impact.
  double time_of_impact = 1;
  /// PairReport::time_of_gap.
  double time_of_gap = 1;
  /// The impacts of the pair, sorted as FrameReport::impacts() is.
  std::vector<ReportedImpact> impacts;
};

/// A diagnostic in a report file.
struct ReportedDiagnostic {
  /// The object, by its ReportedObject::id. There is no value if the diagnostic names no object of the
  /// header.
  std::optional<std::uint32_t> object;
  /// The kind of bad input.
  DiagnosticKind kind = DiagnosticKind::stale_id;
  /// One sentence that says what was wrong and where.
  std::string message;
};

/// A frame of a report file.
struct ReportedFrame {
  /// The number under which the writer wrote the frame.
  std::uint64_t frame = 0;
  /// True if no budget cut a pair short, and no limit left contacts out.
  bool complete = true;
  /// The rows, sorted by the order in which a, then b, were added.
  std::vector<ReportedPair> pairs;
  /// The diagnostics of the step.
  std::vector<ReportedDiagnostic> diagnostics;
  /// The counters and times of the step. Numbers that the file leaves out are 0.
  StepStatistics statistics;
};

/// Reads a file of a ReportWriter back, compressed or not, one frame at a time. One thread at a time may use
/// a reader.
class GRAZE_API ReportReader {
 public:
  /// Opens the file and reads the header. Throws InputError if the file cannot be read or is no report.
  explicit ReportReader(const std::filesystem::path& path);
  /// Closes the file.
  ~ReportReader();
  /// Takes the file of the other reader, which may then only be destroyed or assigned to.
  ReportReader(ReportReader&&) noexcept;
  /// Closes the file of this reader and takes that of the other one, which may then only be destroyed or
  /// assigned to.
  ReportReader& operator=(ReportReader&&) noexcept;

  /// Returns the objects of the header.
  [[nodiscard]] std::span<const ReportedObject> objects() const;
  /// Returns the settings of the header: distances, detail, accuracy, budgets, limits, ways out and contacts
  /// that carry. Other settings are defaults.
  [[nodiscard]] const SceneSettings& settings() const;
  /// Returns ReportWriter::Options::every: the file has each so many-th frame.
  [[nodiscard]] std::uint64_t every() const;
  /// Returns whether the file lists the contacts of its pairs, or their number alone.
  [[nodiscard]] bool has_contacts() const;
  /// Returns the next frame, or no value at the end of the file. Throws InputError, with the line number, if
  /// the line is no frame.
  std::optional<ReportedFrame> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze::io
