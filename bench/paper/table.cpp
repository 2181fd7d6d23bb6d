#include "table.hpp"

#include <cstdio>
#include <stdexcept>

namespace difmesh::paper {
namespace {

void write_row(std::ostream& out, const std::vector<std::string>& row, const char* before,
               const char* between, const char* after) {
  out << before;
  for (std::size_t n = 0; n < row.size(); ++n) {
    out << (n > 0 ? between : "") << row[n];
  }
  out << after;
}

void check(const std::ofstream& out, const std::filesystem::path& path) {
  if (!out) {
    throw std::runtime_error("cannot write '" + path.string() + "'");
  }
}

std::string csv_text(const std::string& text) {
  return text.find_first_of(",\"") == std::string::npos ? text : '"' + text + '"';
}

}  // namespace

void Table::write_csv(const std::filesystem::path& path) const {
  std::ofstream out(path);
  std::vector<std::vector<std::string>> all{head_};
  all.insert(all.end(), rows_.begin(), rows_.end());
  for (std::vector<std::string>& row : all) {
    for (std::string& cell : row) {
      cell = csv_text(cell);
    }
    write_row(out, row, "", ",", "\n");
  }
  out.flush();
  check(out, path);
}

void Table::write_markdown(const std::filesystem::path& path) const {
  std::ofstream out(path);
  write_row(out, head_, "| ", " | ", " |\n");
  write_row(out, std::vector<std::string>(head_.size(), "---"), "|", "|", "|\n");
  for (const std::vector<std::string>& row : rows_) {
    write_row(out, row, "| ", " | ", " |\n");
  }
  out.flush();
  check(out, path);
}

std::string number(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace difmesh::paper
