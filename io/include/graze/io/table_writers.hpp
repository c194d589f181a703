#pragma once

#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/io/scene_snapshot.hpp>
#include <memory>

namespace graze::io {

/// @addtogroup io_exports
/// @{

/// Writes contacts as a table in CSV: a line for each contact of each frame. docs/formats.md lists the
/// columns. Every double is written so that reading it back gives the same bits. The locale plays no part.
/// One thread at a time may use a writer.
class GRAZE_API ContactTable {
 public:
  /// Opens the file and writes the line of column names. A file of that name is written over. Throws
  /// InputError if the file cannot be written.
  explicit ContactTable(const std::filesystem::path& path);
  /// Ends the file without saying whether all of it arrived. Call close() to know.
  ~ContactTable();
  /// Takes the file of the other writer, which may then only be destroyed or assigned to.
  ContactTable(ContactTable&&) noexcept;
  /// Ends the file of this writer and takes that of the other one, which may then only be destroyed or
  /// assigned to.
  ContactTable& operator=(ContactTable&&) noexcept;

  /// Appends the contacts of a frame. Throws InputError if the disk takes no more.
  void write(const SceneSnapshot& snapshot);
  /// Ends the file. Throws InputError if not all of it arrived on the disk.
  void close();
  /// Returns the number of contacts so far.
  [[nodiscard]] std::uint64_t row_count() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes distances as a table in CSV: a line for each row of each report. docs/formats.md lists the columns.
/// Every double is written so that reading it back gives the same bits. The locale plays no part. One thread
/// at a time may use a writer.
class GRAZE_API DistanceTable {
 public:
  /// Opens the file and writes the line of column names. A file of that name is written over. Throws
  /// InputError if the file cannot be written.
  explicit DistanceTable(const std::filesystem::path& path);
  /// Ends the file without saying whether all of it arrived. Call close() to know.
  ~DistanceTable();
  /// Takes the file of the other writer, which may then only be destroyed or assigned to.
  DistanceTable(DistanceTable&&) noexcept;
  /// Ends the file of this writer and takes that of the other one, which may then only be destroyed or
  /// assigned to.
  DistanceTable& operator=(DistanceTable&&) noexcept;

  /// Appends the rows of a frame. Throws InputError if the disk takes no more.
  void write(const SceneSnapshot& snapshot);
  /// Ends the file. Throws InputError if not all of it arrived on the disk.
  void close();
  /// Returns the number of rows so far.
  [[nodiscard]] std::uint64_t row_count() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze::io
