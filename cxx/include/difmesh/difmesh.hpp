#pragma once
/// \file difmesh.hpp
/// All of the core in one include.

#include "difmesh/constrained_smoothing.hpp"
#include "difmesh/curvature.hpp"
#include "difmesh/error.hpp"
#include "difmesh/field_view.hpp"
#include "difmesh/fractions_from_function.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/mollify.hpp"
#include "difmesh/normals.hpp"
#include "difmesh/options.hpp"
#include "difmesh/plane.hpp"
#include "difmesh/printable.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"
#include "difmesh/smoothing.hpp"
#include "difmesh/version.hpp"
#include "difmesh/weld.hpp"
