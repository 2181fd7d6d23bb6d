#pragma once
// Tables of results: CSV for the plots, Markdown for the page.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace difmesh::paper {

/// Rows of text under a head.
class Table {
 public:
  explicit Table(std::vector<std::string> head) : head_(std::move(head)) {}
  /// \pre as many cells as in the head
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// \throw std::runtime_error naming the file
  void write_csv(const std::filesystem::path& path) const;
  void write_markdown(const std::filesystem::path& path) const;

 private:
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> rows_;
};

/// With some significant digits, in the shortest form: "0.0251", "2.4e-05".
[[nodiscard]] std::string number(double value, int digits = 6);

/// What a run found of what the paper, or we, say.
struct Claim {
  std::string text;
  std::string wanted;
  std::string measured;
  bool holds = false;
};

}  // namespace difmesh::paper
