#pragma once
/// \file nrrd_data.hpp
/// The samples of an NRRD file, behind its header or in other files.

#include "input_file.hpp"
#include "nrrd_header.hpp"
#include "value_cells.hpp"

namespace difmesh::detail {

/// The samples in the order of the file.
/// \param outside whether data files may lie outside the folder of the header
/// \throw Error file_missing, file_format; OutOfMemory
[[nodiscard]] RawCells read_nrrd_data(const InputFile& file, const NrrdHeader& header,
                                      bool outside);

}  // namespace difmesh::detail
