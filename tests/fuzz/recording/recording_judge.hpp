#pragma once

#include <filesystem>
#include <string>

namespace graze::fuzz {

/// Opens, checks, replays and cuts a recording. Says what does not hold, or nothing. What must hold:
///
/// - Each of these is done or refused by an Error of one line.
/// - The replay gives one position for each vertex.
/// - A scene refuses no call of a record that was not refused. `made` says that the recording's own
///   diagnostics have the made_message, so that those of the scene can be told from them.
/// - A made recording is replayed if its check passes, and only then.
/// - A part that was cut out of it passes the check and is replayed.
///
/// `folder` is for files.
std::string problem_of_recording(const std::filesystem::path& path, const std::filesystem::path& folder,
                                 bool made);

}  // namespace graze::fuzz
