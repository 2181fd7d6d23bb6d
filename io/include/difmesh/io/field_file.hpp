#pragma once
/// \file field_file.hpp
/// Fields of fractions in files: NumPy (.npy), NRRD (.nrrd, .nhdr) and raw.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/values.hpp"

namespace difmesh {

/// A field that owns its memory, in the layout of the file that it came from.
struct FieldFile {
  ScalarType type = ScalarType::float64;
  Index3 dims{0, 0, 0};     ///< cells in x, y, z
  Index3 strides{0, 0, 0};  ///< elements from one cell to the next; negative for flipped axes
  std::int64_t first = 0;   ///< element of cell (0,0,0), counted from the start of `cells`
  std::optional<Vec3> origin = {};   ///< low corner of cell (0,0,0), where the file tells it
  std::optional<Vec3> spacing = {};  ///< where the file tells it
  Array<std::byte> cells;            ///< elements of `type` in the machine's byte order
  ValueType file_type = ValueType::float64;  ///< of the elements in the file
  /// What a user must know though it is no error, one English sentence each that names the file:
  /// UTF-8 of at most 1000 bytes, without control characters.
  std::vector<std::string> warnings = {};

  /// Valid as long as `cells` is neither changed nor destroyed.
  [[nodiscard]] FieldView view() const;
  /// The grid, with origin (0,0,0) and spacing (1,1,1) where the file tells none.
  [[nodiscard]] Grid grid() const;
};

/// Where the elements of a raw file are: x fastest, then y, then z, up to the end of the file.
struct RawLayout {
  Index3 dims{0, 0, 0};  ///< cells in x, y, z
  ValueType type = ValueType::float64;
  bool big_endian = false;
  std::int64_t offset = 0;  ///< bytes before the first element
};

struct ReadFieldOptions {
  /// In place of what the file tells, which is not judged then. With both, or with `spacing` and a
  /// file that tells no origin, axes that cannot be made sense of are taken as x, y, z in the order
  /// of the file, with a warning.
  std::optional<Vec3> origin = {};
  std::optional<Vec3> spacing = {};
  /// The values that stand for 0 and 1. If not set, integers stand for value / (largest value of
  /// their type); negative ones and floats below 0 or above 1 are then for reconstruct() to judge.
  std::optional<ValueRange> values = {};
  std::vector<std::int64_t> labels = {};  ///< if not empty: cells with one of these values are full
  /// Whether data files may lie outside the folder of the header; otherwise they must be named
  /// relative to it and lie in it or below, after symbolic links are resolved.
  bool outside_files = false;
};

/// Reads a field; the extension of the path, in any case of letters, tells the format.
/// - `.npy`, versions 1 to 3: indexed [k,j,i]: C order has x fastest, Fortran order z. Types f2,
///   f4, f8, integers of 1 to 8 bytes in either byte order, and b1: true is 1.
/// - `.nrrd`, `.nhdr`, NRRD0001 to NRRD0005: all types but block; encodings raw, gzip and ascii;
///   data attached, in another file or in several (LIST, %d). Every sample is a cell. `space
///   origin` and node-centred `axis mins` are the centre of the first one, other `axis mins` its
///   low corner. `space directions` must lie along the axes to 1e-6, in any order and sense:
///   strides put them in the order x, y, z and make them ascend. Coordinates are taken as they
///   stand in any named space; there is no change between, say, LPS and RAS.
/// Axes beyond three must have one sample, and the field's three must follow from that.
/// Elements become uint8 or uint16 where the file has these, uint8 by `labels`; float32 where its
/// elements have up to 2 bytes or are float32, and float64 otherwise. Integers of other types bring
/// a warning where doubt_of_scale() has one; of uint8 and uint16 reconstruct() has it.
///
/// The file is checked against its header before memory is taken: never more than five times the
/// size of its data, or 1032 times five for gzip, as deflate gives 1032 at most. Of inflated bytes
/// 2^30 are skipped at most, or 64 times as many as are wanted.
/// \throw Error file_missing if the file cannot be opened; file_format if it is malformed,
///   truncated, of a kind not supported or of an unknown extension; too_large if its sizes overflow
///   63 bits; invalid_argument for options; OutOfMemory. The message names the file and the matter.
///   Values are not looked at: NaN is for the caller to find.
///
/// Cost: one pass over the file. Thread safety: concurrent calls are safe.
/// Source: NEP 1 of NumPy; "Definition of NRRD File Format", G. Kindlmann, Teem.
[[nodiscard]] FieldFile read_field(const std::filesystem::path& path,
                                   const ReadFieldOptions& options = {});

/// Reads a raw file, whatever its extension. It must end with the last element.
/// \throw as above, and invalid_argument for a layout without cells or with a negative offset.
[[nodiscard]] FieldFile read_field(const std::filesystem::path& path, const RawLayout& layout,
                                   const ReadFieldOptions& options = {});

/// The faces of cells along a stretched axis (Grid::faces) from a .npy of rank 1, of any type of
/// numbers. \throw Error file_missing, file_format; OutOfMemory
[[nodiscard]] std::vector<double> read_faces(const std::filesystem::path& path);

enum class FieldFormat : std::uint8_t {
  npy,   ///< version 1.0, little endian, C order (nz,ny,nx). Holds no origin and no spacing
  nrrd,  ///< NRRD0004, little endian, attached; `space origin` is the centre of cell (0,0,0)
};

struct WriteFieldOptions {
  std::optional<FieldFormat> format = {};  ///< by the extension of the path if not set
  /// Type of the elements, that of the field if not set. Fractions are rounded to the nearest value
  /// of the type; integers hold [0,1] only, so values beyond are clamped.
  std::optional<ScalarType> type = {};
  bool gzip = true;    ///< NRRD: gzip or raw
  int gzip_level = 6;  ///< 1 fast to 9 small
};

/// Writes a field, with its grid where there is one and the format can hold it. Values whose type
/// is kept, spacing and origin come back from read_field() bit for bit. The file appears under its
/// name when it is complete and not before; on failure nothing is left and an older file stays as
/// it was. Targets that are no regular files, such as /dev/stdout, are written directly.
/// \throw Error invalid_argument (field without data, options, grid of other dims, unknown
///   extension), invalid_grid, too_large; invalid_value for a NaN that has to become an integer,
///   with its cell; file_write with the path and the system's reason.
///
/// Cost: one pass over the field, and deflate. Thread safety: concurrent calls are safe.
void write_field(const std::filesystem::path& path, const FieldView& field,
                 const std::optional<Grid>& grid = {}, const WriteFieldOptions& options = {});

}  // namespace difmesh
