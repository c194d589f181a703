#include "bench/aims.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/text.hpp"
#include "output/text_table.hpp"

namespace graze::bench {
namespace {

using tools::format;

std::string where(const Run& run) {
  const std::string slow = run.slow == 1 ? "" : format(", %zu times slower", run.slow);
  return run.scene + ", " + tools::counted(run.threads, "thread") + (run.evict ? ", evicted" : "") + slow;
}

bool is_one_of(const std::string& scene, std::initializer_list<std::string_view> names) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
    return scene.starts_with(name) && (scene.size() == name.size() || std::isdigit(scene[name.size()]) == 0);
  });
}

/// The fastest that is neither graze nor a limit. Null where none answered right.
const Timing* fastest_peer(const Run& run) {
  const Timing* fastest = nullptr;
  for (const Timing& timing : run.timings) {
    if (!timing.complaint.empty() || timing.name.starts_with(graze_name) || is_limit(timing.name)) continue;
    if (fastest == nullptr || timing.median < fastest->median) fastest = &timing;
  }
  return fastest;
}

/// At most a part of the fastest peer's time, or within a multiple of the boxes' where that is more.
void add_against_peers(const Run& run, double part, double of_boxes, std::vector<Aim>& aims) {
  const Timing* const peer = fastest_peer(run);
  const double graze = run.median(graze_name);
  if (peer == nullptr || std::isnan(graze)) return;
  const double by_peer = graze / peer->median;
  const double by_boxes = graze / run.median(box_limit);
  const std::string task(1, static_cast<char>(run.task));
  if (of_boxes * run.median(box_limit) > part * peer->median)
    aims.push_back({task + " / boxes", where(run), by_boxes, of_boxes, false,
                    format("%.3f of %s's", by_peer, peer->name.c_str())});
  else
    aims.push_back({task + " / fastest peer", where(run), by_peer, part, false,
                    format("%s; %.2f x boxes", peer->name.c_str(), by_boxes)});
}

void add_of_one_run(const Run& run, std::vector<Aim>& aims) {
  const Timing* const graze = run.timing(graze_name);
  if (graze == nullptr || !graze->complaint.empty()) return;
  const bool is_moving = is_one_of(run.scene, {"S1", "S2", "S3", "S4", "S5", "S6", "S7"});
  if (run.task == Task::A && is_moving) add_against_peers(run, 0.5, 1.3, aims);
  if (run.task == Task::B && is_moving) add_against_peers(run, 1.0 / 8, 1.5, aims);
  if (run.near_pairs >= 1000)
    aims.push_back(
        {"B: ns a near pair", where(run), 1e6 * graze->median / static_cast<double>(run.near_pairs), 15,
         false,
         format("%zu vertex-face and edge-edge pairs; %.3g ns a contact, %.0f a frame", run.near_pairs,
                1e6 * graze->median / run.graze.contacts_per_frame, run.graze.contacts_per_frame)});
  if (run.task == Task::D && !std::isnan(run.median("FCL")))
    aims.push_back({"D / FCL", where(run), graze->median / run.median("FCL"), 1.0 / 20});
  if (run.task == Task::A && !std::isnan(run.median(told_name)))
    aims.push_back(
        {"A, told of motion / read", where(run), run.median(told_name) / run.median(read_limit), 0.2});
  if (is_one_of(run.scene, {"S1", "S2", "S6"})) {
    const std::string what(1, static_cast<char>(run.task));
    const std::string note = format("of %zu frames", run.frames);
    aims.push_back({what + ": p99 / median", where(run), graze->p99 / graze->median, 2, false, note});
    aims.push_back({what + ": worst / median", where(run), graze->worst / graze->median, 4, false, note});
  }
  if (run.task == Task::A && run.threads == 1)
    aims.push_back({"memory, bytes a vertex", where(run),
                    run.graze.object_bytes / static_cast<double>(run.vertices), 40});
  if (run.task == Task::A && run.threads == 1 && is_one_of(run.scene, {"S3"}))
    aims.push_back({"first frame / median", where(run), graze->first / graze->median, 20});
}

/// Adds the aims of the scenes at rest: objects that rest should cost nothing.
void add_of_rest(const Run& run, std::vector<Aim>& aims) {
  const double graze = run.median(graze_name);
  if (std::isnan(graze)) return;
  const std::string task(1, static_cast<char>(run.task));
  if (run.scene == "S8a") aims.push_back({task + ": ms at rest", where(run), graze, 0.05});
  if (run.scene == "S8b") aims.push_back({task + " / read", where(run), graze / run.median(read_limit), 3});
  if (run.scene == "S9")
    aims.push_back({task + " / read movers", where(run), graze / run.median(movers_limit), 2});
}

/// A fixed landscape against what lies under the props.
void add_of_cropping(const Run& whole, const Run& part, std::vector<Aim>& aims) {
  const double ratio = whole.median(graze_name) / part.median(graze_name);
  const std::string task(1, static_cast<char>(whole.task));
  if (!std::isnan(ratio)) aims.push_back({task + " / cropped", where(whole), ratio, 1.3});
}

/// Two threads against one, in the same scene and task.
void add_of_threads(const Run& one, const Run& two, std::vector<Aim>& aims) {
  const double gain = one.median(graze_name) / two.median(graze_name);
  if (std::isnan(gain)) return;
  if (two.task == Task::B && is_one_of(two.scene, {"S2", "S3", "S4", "S5"}))
    aims.push_back({"B: gain of a second thread", where(two), gain, 1.8, true});
  if (two.task == Task::A)
    aims.push_back({"A: gain of a second thread", where(two), gain,
                    one.median(read_limit) / two.median(read_limit), true, "the gain of reading"});
}

/// How a figure grows with the number of objects, as a power of it.
double exponent(double few, double many, const Run& from, const Run& to) {
  return std::log(many / few) / std::log(static_cast<double>(to.objects) / static_cast<double>(from.objects));
}

/// More and more objects at one density.
void add_of_growth(const Run& from, const Run& to, std::vector<Aim>& aims) {
  const std::string task(1, static_cast<char>(to.task));
  const std::string note = format("from %zu to %zu objects", from.objects, to.objects);
  const double time = exponent(from.median(graze_name) / from.median(read_limit),
                               to.median(graze_name) / to.median(read_limit), from, to);
  if (!std::isnan(time)) aims.push_back({task + " / read grows by power", where(to), time, 0.1, false, note});
  if (to.task == Task::A && to.threads == 1)
    aims.push_back({"memory grows by power", where(to),
                    exponent(from.graze.object_bytes, to.graze.object_bytes, from, to), 1.05, false, note});
}

}  // namespace

std::vector<Aim> aims_of(const std::vector<Run>& runs) {
  std::vector<Aim> aims;
  for (const Run& run : runs) {
    add_of_one_run(run, aims);
    add_of_rest(run, aims);
  }
  for (const Run& whole : runs)
    for (const Run& part : runs)
      if (whole.scene == "S10a" && part.scene == "S10b" && whole.task == part.task &&
          whole.threads == part.threads)
        add_of_cropping(whole, part, aims);
  for (const Run& from : runs)
    for (const Run& to : runs)
      if (from.scene == "G100" && to.scene == "G10000" && from.task == to.task && from.threads == to.threads)
        add_of_growth(from, to, aims);
  for (const Run& one : runs)
    for (const Run& two : runs)
      if (one.threads == 1 && two.threads == 2 && one.scene == two.scene && one.task == two.task)
        add_of_threads(one, two, aims);
  return aims;
}

std::string table_of(const std::vector<Aim>& aims) {
  const tools::TextTable table({{"aim", 26, tools::Align::left},
                                {"where", 14, tools::Align::left},
                                {"measured", 9},
                                {"wanted", 8},
                                {"", 11, tools::Align::left},
                                {"", 0, tools::Align::left}});
  std::string text =
      "\nAims: what graze's developers want of it (docs/performance.md). Each row compares a figure that was "
      "measured\nabove with the least or most that is wanted. An aim that is not reached is no error.\n\n" +
      table.head();
  for (const Aim& aim : aims)
    text += table.row({aim.what, aim.where, tools::rounded(aim.measured, 4),
                       format("%s %6.4g", aim.is_at_least ? "≥" : "≤", aim.wanted),
                       aim.is_reached() ? "reached" : "not reached", aim.note});
  return text;
}

nlohmann::ordered_json figures_of(const std::vector<Aim>& aims) {
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  for (const Aim& aim : aims)
    figures.push_back({{"what", aim.what},
                       {"where", aim.where},
                       {"measured", aim.measured},
                       {"wanted", aim.wanted},
                       {"is_at_least", aim.is_at_least},
                       {"is_reached", aim.is_reached()},
                       {"note", aim.note}});
  return figures;
}

}  // namespace graze::bench
