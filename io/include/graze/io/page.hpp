#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/pair_filters.hpp>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace graze::io {

/// @addtogroup io_pages
/// @{

/// Says what a page shows of an object.
struct PageObject {
  /// The name of the object.
  std::string name;
  /// The mesh that the object was added with. Objects that share one are drawn from one copy.
  std::shared_ptr<const Mesh> mesh;
  /// How the object may move. Deformable objects have positions, others have a pose.
  Motion motion = Motion::deformable;
  /// ObjectSettings::user_data of the object.
  std::uint64_t user_data = 0;
  /// ObjectSettings::solid of the object. The page says it, and draws a solid that is inside another one
  /// through the other.
  bool solid = false;
  /// ObjectSettings::swept of the object. The page names the settings of sweeps if an object is swept.
  bool swept = false;
  /// The settings of the object that decide what is tested. What has a member of its own above does not count
  /// here, nor does what is for answers between steps. The page names those that are not as usual. It needs
  /// them where it computes.
  ObjectSettings settings = {};
};

/// Says what a page is of, and how large it may become.
struct PageOptions {
  /// The title of the page.
  std::string title = {};
  /// The source of the frames, such as the name of a scene file.
  std::string source = {};
  /// The settings of the scene.
  SceneSettings settings = {};
  /// The page has each frame whose number, counted in calls of PageWriter::frame(), this number divides. It
  /// is at least 1.
  std::uint32_t every = 1;
  /// How many calls of PageWriter::frame() there will be. No value means that nobody knows. Then there is
  /// no estimate, and #max_bytes has no effect.
  std::optional<std::uint64_t> expected_frames = std::nullopt;
  /// The size that the page should not exceed, in bytes. The writer estimates the size from the first frames,
  /// and makes PageWriter::every() larger until the estimate is below. No value means no limit.
  std::optional<std::uint64_t> max_bytes = std::nullopt;
  /// False writes 0 for all times, and leaves out StepBytes::threads. Equal answers are then equal
  /// files.
  bool include_times = true;
};

/// Writes the frames of a scene into one page that plays them in a browser. docs/page_format.md describes the
/// data. One thread at a time may use a writer.
///
///     PageWriter page("view.html", page_template, {.title = "drape", .settings = scene.settings()});
///     page.add_object(cloth, {.name = "cloth", .mesh = mesh});
///     for (std::uint64_t frame = 0; frame < 100; ++frame) {
///       page.set_positions(cloth, positions);
///       page.frame(frame, *scene.step());
///     }
///     page.close();
///
/// The writer keeps up to 32 frames in memory, or fewer if these take more than some megabytes. It also keeps
/// the last position of each object, and some numbers of each frame.
///
/// The file appears under its name in close(). Until then the data stands in a file beside it, whose name
/// ends in `.part`. A path that names something else than a file, such as a pipe, is written at once.
class GRAZE_API PageWriter {
 public:
  /// The line of a template in whose place the data stands.
  static constexpr std::string_view data_line = "<!-- graze-data -->";

  /// Opens the file. `page_template` is the text of the viewer's page. If it is empty, the file has the data
  /// alone, which a page opens later. Such a file should end in `.grazeview`.
  ///
  /// Throws InputError if the file cannot be written, and Error if a template has no #data_line.
  PageWriter(const std::filesystem::path& path, std::string_view page_template, const PageOptions& options);
  /// Removes what was written, unless close() ended the file.
  ~PageWriter();
  /// Takes the file of the other writer, which may then only be destroyed or assigned to.
  PageWriter(PageWriter&&) noexcept;
  /// Removes what this writer wrote, unless close() ended it, and takes the file of the other one. The other
  /// writer may then only be destroyed or assigned to.
  PageWriter& operator=(PageWriter&&) noexcept;

  /// Adds an object, which is there from the next frame on. It stands at the rest shape of its mesh until
  /// set_positions() or set_pose() moves it. After Scene::replace_mesh() remove the object and add it again
  /// with the new mesh. Throws Error if the id names an object that is there, or if there is no mesh. Throws
  /// InputError if the disk takes no more.
  void add_object(ObjectId id, const PageObject& object);
  /// Removes an object. It is not drawn in the next frame. Reports may still name it. Throws Error if the id
  /// was not added, or is removed already.
  void remove_object(ObjectId id);
  /// Moves a deformable object in the next frame. The positions are copied, in the caller's units. Equal
  /// positions cost nothing.
  ///
  /// A vertex that no face uses is not drawn. Neither is a vertex with a coordinate that is not finite or is
  /// beyond 2^120. Throws Error if the id names no deformable object of the page, or for a wrong number of
  /// positions.
  void set_positions(ObjectId id, const PositionView& positions);
  /// Moves a rigid or fixed object in the next frame, by the first three rows of its matrix. Throws Error if
  /// the id names no such object of the page.
  void set_pose(ObjectId id, const std::array<double, 12>& rows);
  /// Moves a rigid or fixed object in the next frame. Throws Error if the id names no such object of the
  /// page.
  void set_pose(ObjectId id, const Eigen::Isometry3d& pose) {
    std::array<double, 12> rows;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        rows[static_cast<std::size_t>(row * 4 + column)] = pose.matrix()(row, column);
    set_pose(id, rows);
  }
  /// Says what counts for pairs from the next frame on, in place of what was said before. The page needs it
  /// where it computes. What names an object that the page does not have is left out. After an object was
  /// added for an id anew, say it again.
  void set_pair_filters(const PairFilters& filters);
  /// Marks the next frame as one in which a replay gave another answer than the recording has.
  void mark_diverged();
  /// Says that so many frames of the source are missing before the next frame, since a recorder dropped them.
  /// Before close() it says that they are missing at the end. 0 says nothing.
  void mark_dropped(std::uint64_t frames);
  /// Returns whether the next call of frame() will be a frame of the page. If not, there is no need to move
  /// objects before it that will be moved later.
  [[nodiscard]] bool takes_next_frame() const;
  /// Appends a frame under the number `number`, which is the caller's. Throws InputError if the disk takes no
  /// more. Throws Error if the report has an object that was not added.
  void frame(std::uint64_t number, const FrameReport& report);
  /// Ends the file and gives it its name. Throws InputError if not all of it arrived on the disk.
  void close();

  /// Returns which frames the page has: each whose number, counted in calls of frame(), this number divides.
  [[nodiscard]] std::uint32_t every() const;
  /// Returns about how many bytes the page would have if #every stayed as the options say. It returns 0 until
  /// enough frames are there, and if nobody knows how many will come.
  [[nodiscard]] std::uint64_t estimated_bytes() const;
  /// Returns how many frames the page has so far.
  [[nodiscard]] std::uint64_t frame_count() const;
  /// Returns how many bytes were written so far. After close() this is the size of the file.
  [[nodiscard]] std::uint64_t byte_count() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze::io
