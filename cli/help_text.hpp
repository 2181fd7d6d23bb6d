#pragma once
/// \file help_text.hpp
/// How --help looks: CLI11's layout, with what is required in the usage line and nothing but our
/// own words beside the options.

#include <CLI/CLI.hpp>
#include <string>

namespace difmesh::cli {

class HelpText : public CLI::Formatter {
 public:
  HelpText();
  std::string make_usage(const CLI::App* command, std::string name) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  /// The name and the first line of the description.
  std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace difmesh::cli
