#pragma once
/// \file npy.hpp
/// NumPy's .npy. Source: R. Kern, "A Simple File Format for NumPy Arrays", NEP 1.

#include <filesystem>
#include <vector>

#include "atomic_file.hpp"
#include "difmesh/io/field_file.hpp"

namespace difmesh::detail {

[[nodiscard]] FieldFile read_npy(const std::filesystem::path& path,
                                 const ReadFieldOptions& options);
/// \throw Error as read_faces()
[[nodiscard]] std::vector<double> read_faces_npy(const std::filesystem::path& path);
void write_npy(AtomicFile& file, const FieldView& field, ScalarType type);

}  // namespace difmesh::detail
