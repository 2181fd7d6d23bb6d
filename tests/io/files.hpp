#pragma once
/// \file files.hpp
/// Files made by hand for the tests of readers and writers.

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/field_view.hpp"

namespace test {

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A new folder, removed with all that is in it.
class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "difmesh_test_XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  [[nodiscard]] std::filesystem::path file(const std::string& name,
                                           const std::string& bytes) const {
    // A file cut to nothing and filled again is forced to the disk by ext4: 5 ms each time.
    std::filesystem::remove(path_ / name);
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    REQUIRE(read_bytes(path_ / name) == bytes);
    return path_ / name;
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

/// NumPy's format, version 1.0, of float64 in one axis.
inline void write_table(const std::filesystem::path& path, const std::vector<double>& numbers) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(numbers.size()) + ",), }";
  header.resize(117, ' ');
  header += '\n';
  std::ofstream file(path, std::ios::binary);
  file << "\x93NUMPY\x01" << '\0' << static_cast<char>(118) << '\0' << header;
  file.write(reinterpret_cast<const char*>(numbers.data()),
             static_cast<std::streamsize>(numbers.size() * sizeof(double)));
}

/// Runs `action` and checks that it throws an Error of this code whose message holds all the words.
template <class Action>
void check_error(const Action& action, difmesh::ErrorCode code,
                 std::initializer_list<std::string> words) {
  try {
    action();
  } catch (const difmesh::Error& error) {
    const std::string message = error.what();
    CAPTURE(message);
    CHECK(error.code() == code);
    for (const std::string& word : words) {
      CAPTURE(word);
      CHECK(message.find(word) != std::string::npos);
    }
    return;
  }
  const std::string first_word = words.begin()[0];
  CAPTURE(first_word);
  FAIL_CHECK("no error was thrown");
}

/// The bytes of a number, in either order.
template <class T>
std::string bytes_of(T value, bool big_endian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian != (std::endian::native == std::endian::big)) {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

/// Element (i,j,k) of a view, as stored.
inline double element(const difmesh::FieldView& view, std::int64_t i, std::int64_t j,
                      std::int64_t k) {
  const std::int64_t at = i * view.strides[0] + j * view.strides[1] + k * view.strides[2];
  switch (view.type) {
    case difmesh::ScalarType::float32:
      return static_cast<const float*>(view.data)[at];
    case difmesh::ScalarType::float64:
      return static_cast<const double*>(view.data)[at];
    case difmesh::ScalarType::uint8:
      return static_cast<const std::uint8_t*>(view.data)[at];
    case difmesh::ScalarType::uint16:
      return static_cast<const std::uint16_t*>(view.data)[at];
  }
  return -1.0;
}

/// What the fields of the tests hold in cell (i,j,k): different in every cell of small fields, and
/// exact in each of the four types.
inline double value_at(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<double>(1 + i + 10 * j + 50 * k);
}

/// Calls action(i, j, k) for every cell, x fastest.
template <class Action>
void for_cells(const difmesh::Index3& dims, const Action& action) {
  for (std::int64_t k = 0; k < dims[2]; ++k) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t i = 0; i < dims[0]; ++i) {
        action(i, j, k);
      }
    }
  }
}

/// Whether every cell of the view holds value_at().
inline bool holds_values(const difmesh::FieldView& view, const difmesh::Index3& dims) {
  bool equal = view.dims == dims;
  if (equal) {
    for_cells(dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
      equal = equal && element(view, i, j, k) == value_at(i, j, k);
    });
  }
  return equal;
}

/// The elements of a field of value_at(), x fastest.
template <class T>
std::string elements(const difmesh::Index3& dims, bool big_endian = false) {
  std::string bytes;
  for_cells(dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    bytes += bytes_of(static_cast<T>(value_at(i, j, k)), big_endian);
  });
  return bytes;
}

}  // namespace test
