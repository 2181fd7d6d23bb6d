#pragma once
/// \file field_input.hpp
/// The options with which every command takes a field, and its reading.

#include <CLI/CLI.hpp>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "difmesh/grid.hpp"
#include "difmesh/io/field_file.hpp"
#include "json.hpp"

namespace difmesh::cli {

/// A field as the command line asks for it.
struct FieldInput {
  std::string path;
  std::optional<Vec3> origin;
  std::optional<Vec3> spacing;
  std::array<std::string, 3> edges;  ///< files of faces by axis; empty: the axis is uniform
  std::optional<Index3> raw_dims;    ///< set together with raw_type
  std::optional<ValueType> raw_type;
  bool raw_big_endian = false;
  std::int64_t raw_offset = 0;
  std::optional<double> full_value;
  std::optional<double> empty_value;  ///< goes with full_value
  std::vector<std::int64_t> labels;   ///< exclude full_value
  bool allow_outside = false;

  [[nodiscard]] bool is_raw() const { return raw_dims.has_value(); }
  [[nodiscard]] bool is_stretched(std::size_t axis) const { return !edges[axis].empty(); }
  /// \throw CLI::ValidationError if options contradict each other
  void check() const;
};

/// Where a part of the grid came from: the command line before the file before the default.
enum class Source : std::uint8_t { command_line, file, assumed };

struct LoadedField {
  FieldFile file;
  Grid grid;
  Source origin_from = Source::file;
  Source spacing_from = Source::file;
};

/// The smallest edge of all cells.
[[nodiscard]] double least_edge(const Grid& grid);

/// Adds --origin, --spacing, --edges, what tells values, --raw-* and --allow-outside. `input` must
/// outlive the parsing.
void add_field_options(CLI::App& command, FieldInput& input);

/// \throw Error as read_field()
[[nodiscard]] LoadedField load_field(const FieldInput& input);

/// Says that integers look like a mask or a segmentation (doubt_of_scale()); empty if they do not,
/// or the reader has said it.
[[nodiscard]] std::string scale_warning(const FieldInput& input, const FieldFile& file);

/// "command line", "file" or "assumed".
[[nodiscard]] const char* name_of(Source source);
/// By axis the faces of its cells where it is stretched, else null.
[[nodiscard]] Json edges_json(const Grid& grid);
/// An origin or spacing, null for stretched axes.
[[nodiscard]] Json uniform_json(const Grid& grid, const Vec3& vector);
/// Prints origin and spacing of uniform axes, with a remark where they were assumed, and the
/// extents of stretched ones.
void print_axes(std::ostream& out, const LoadedField& field);

}  // namespace difmesh::cli
