#pragma once
/// \file names.hpp
/// What the choices of files are called; see difmesh/names.hpp.

#include <array>

#include "difmesh/io/field_file.hpp"
#include "difmesh/io/write_mesh_options.hpp"
#include "difmesh/names.hpp"

namespace difmesh {

inline constexpr std::array<Named<FieldFormat>, 2> kFieldFormats{
    {{"npy", FieldFormat::npy}, {"nrrd", FieldFormat::nrrd}}};

inline constexpr std::array<Named<ColorMap>, 2> kColorMaps{
    {{"viridis", ColorMap::viridis}, {"cool_warm", ColorMap::cool_warm}}};

inline constexpr std::array<Named<UpAxis>, 2> kUpAxes{{{"y", UpAxis::y}, {"z", UpAxis::z}}};

inline constexpr std::array<Named<DracoMethod>, 2> kDracoMethods{
    {{"edgebreaker", DracoMethod::edgebreaker}, {"sequential", DracoMethod::sequential}}};

}  // namespace difmesh
