#include "command_mistake.hpp"

#include <vector>

#include "spelling.hpp"

namespace graze::tools {
namespace {

/// The nearest word as a question, then what else there is.
std::string advice(const std::string& word, const std::vector<std::string>& words, const std::string& other) {
  const auto nearest = nearest_word(word, words);
  return "; " + (nearest ? "did you mean " + *nearest + "? " : "") + other;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// The long names of a command's options, with those of its groups.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const CLI::App* group : command.get_subcommands({})) {
    if (!group->get_name().empty()) continue;
    const std::vector<std::string> more = option_names(*group);
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
  return text;
}

/// The first argument that nothing takes; empty where there is none.
std::string first_unknown(const CLI::App& app) {
  const std::vector<std::string> unknown = app.remaining(true);
  return unknown.empty() ? "" : unknown.front();
}

/// A program's name, or that and its command's.
std::string full_name_of(const CLI::App& command) {
  const CLI::App* const program = command.get_parent();
  return program == nullptr ? command.get_name() : program->get_name() + " " + command.get_name();
}

std::string unknown_option(const CLI::App& command, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  const std::string full_name = full_name_of(command);
  return full_name + " has no option " + name +
         advice(name, option_names(command), full_name + " --help lists them");
}

}  // namespace

std::string mistake_of(const CLI::App& app, const CLI::ParseError& error,
                       const std::map<std::string, std::string>& moved) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  const std::string unknown = first_unknown(app);
  const bool is_option = unknown.starts_with('-') && unknown.size() > 1;
  if (is_option) return unknown_option(commands.empty() ? app : *commands.front(), unknown);
  if (commands.empty()) {
    const std::string there_are = "the commands are " + listed(command_names(app));
    if (unknown.empty()) return "expected a command; " + there_are;
    if (const auto found = moved.find(unknown); found != moved.end())
      return unknown + " has moved to another program: run " + found->second + " " + unknown;
    return "there is no command \"" + unknown + "\"" + advice(unknown, command_names(app), there_are);
  }
  const std::string help = "; " + full_name_of(*commands.front()) + " --help says what can be asked for";
  if (!unknown.empty()) return "\"" + unknown + "\" is one argument too many" + help;
  return error.what() + help;
}

}  // namespace graze::tools
