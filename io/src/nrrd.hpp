#pragma once
/// \file nrrd.hpp
/// NRRD fields. Source: G. Kindlmann, "Definition of NRRD File Format", Teem.

#include <filesystem>
#include <optional>

#include "atomic_file.hpp"
#include "difmesh/io/field_file.hpp"

namespace difmesh::detail {

[[nodiscard]] FieldFile read_nrrd(const std::filesystem::path& path,
                                  const ReadFieldOptions& options);
/// options.type is set.
void write_nrrd(AtomicFile& file, const FieldView& field, const std::optional<Grid>& grid,
                const WriteFieldOptions& options);

}  // namespace difmesh::detail
