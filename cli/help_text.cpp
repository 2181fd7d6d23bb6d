#include "help_text.hpp"

#include <algorithm>

namespace difmesh::cli {
namespace {

constexpr std::size_t kColumn = 26;

}  // namespace

HelpText::HelpText() {
  column_width(kColumn);
  label("Positionals", "Arguments");
}

std::string HelpText::make_usage(const CLI::App* command, std::string name) const {
  std::string text = "Usage: " + name;
  for (const CLI::Option* const option : command->get_options()) {
    if (option->get_required()) {
      const std::string word = option->get_positional()       ? option->get_name(true)
                               : option->get_snames().empty() ? "--" + option->get_lnames().front()
                                                              : "-" + option->get_snames().front();
      text += " " + word + make_option_opts(option);
    }
  }
  text += command->get_subcommands({}).empty() ? " [OPTIONS]" : " COMMAND [OPTIONS]";
  return text + "\n";
}

std::string HelpText::make_option_opts(const CLI::Option* option) const {
  return option->get_option_text().empty() ? "" : " " + option->get_option_text();
}

std::string HelpText::make_subcommand(const CLI::App* command) const {
  const std::string description = command->get_description();
  std::string text = "  " + command->get_name();
  text.resize(std::max(kColumn, text.size() + 1), ' ');
  return text + description.substr(0, description.find('\n')) + "\n";
}

}  // namespace difmesh::cli
