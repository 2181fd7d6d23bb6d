#pragma once
/// \file view_page.hpp
/// The page of `difmesh view`, made from web/ when the program is built.

#include <string_view>

namespace difmesh::cli {

/// HTML with three.js in it; between the two goes the scene as JSON, without the character '<'.
extern const std::string_view kPageBeforeScene;
extern const std::string_view kPageAfterScene;

}  // namespace difmesh::cli
