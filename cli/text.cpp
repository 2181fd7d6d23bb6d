#include "text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <iostream>

#include "difmesh/printable.hpp"

namespace difmesh::cli {
namespace {

constexpr std::size_t kNameColumn = 18;

}  // namespace

std::string exact(double number) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return {digits.data(), result.ptr};
}

std::string exact(const Vec3& vector) {
  return exact(vector[0]) + " " + exact(vector[1]) + " " + exact(vector[2]);
}

std::string rounded(double number, int digits) {
  std::array<char, 64> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), number,
                                    std::chars_format::general, digits);
  return {text.data(), result.ptr};
}

std::string rounded(const Vec3& vector, int digits) {
  return rounded(vector[0], digits) + " " + rounded(vector[1], digits) + " " +
         rounded(vector[2], digits);
}

std::string cell_text(const Index3& cell) {
  std::string text = "(";  // g++ 12 warns of "(" + std::string&&, falsely
  text += std::to_string(cell[0]) + ", " + std::to_string(cell[1]) + ", " +
          std::to_string(cell[2]) + ")";
  return text;
}

std::string dims_text(const Index3& dims) {
  return std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " +
         std::to_string(dims[2]);
}

std::string count_of(std::int64_t count, std::string_view thing) {
  return std::to_string(count) + " " + std::string(thing) + (count == 1 ? "" : "s");
}

void warn(const std::string& message) {
  std::cerr << "difmesh: warning: " << printable(message) << '\n';
}

void warn_all(const std::vector<std::string>& messages) {
  for (auto message = messages.begin(); message != messages.end(); ++message) {
    if (std::find(messages.begin(), message, *message) == message) {
      warn(*message);
    }
  }
}

void print_fact(std::ostream& out, std::string_view name, std::string_view value) {
  const std::size_t gap = name.size() < kNameColumn ? kNameColumn - name.size() : 1;
  out << name << std::string(gap, ' ') << printable(value) << '\n';
}

}  // namespace difmesh::cli
