#pragma once

#include <CLI/App.hpp>

namespace graze::tools {

// The commands about recordings, which `graze run --record` and graze::Recorder write.

/// `graze replay`: does a recording again and compares every frame. It exits with code 1 where one differs.
void add_replay_command(CLI::App& app);
/// `graze info`: says what a recording holds.
void add_info_command(CLI::App& app);
/// `graze worst`: finds the deepest contacts, the largest jumps and the longest steps of a recording.
void add_worst_command(CLI::App& app);
/// `graze cut`: writes a part of a recording into a file of its own.
void add_cut_command(CLI::App& app);
/// `graze view`: writes a page that shows a recording in a browser.
void add_view_command(CLI::App& app);
/// `graze picture`: draws a frame of a recording.
void add_picture_command(CLI::App& app);
/// `graze export`: writes a recording as files of other programs.
void add_export_command(CLI::App& app);

}  // namespace graze::tools
